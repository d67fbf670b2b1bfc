// The program's answers about studies and their calibrations. Nothing is checked or computed here that
// the program checks or computes.
import {asked} from './api';

export interface Range { restitution: [number, number]; sliding_friction: [number, number]; rolling_friction: [number, number] }

export interface Form {
  grains: {name: string; plural: string; with_wall: Range; with_grain: Range; source: string}[];
  plates: string[];
  parts: string[];
  experiments: {name: string; description: string; value_name: string; unit: string; is_default: boolean; has_tube: boolean; parts: string[]}[];
  usual_grain: string;
  usual_plate: string;
}

// The user's input for a new study, as typed.
export interface Said {
  study: string;
  grains: string;
  plate: string;
  grain_mm: string[];
  density_kg_m3: string;
  tube_mm: string[];
  experiments: string[];
  [part: string]: string | string[];
}

export interface Draft {
  command: string;
  faults: {field: string; text: string}[];
  title: string;
  assumed: string[];
  warning: string | null;
  sheets: {experiment: string; name: string; columns: string[]}[];
  usual: {grain_mm: number[]; density_kg_m3: number; tube_mm: number[]};
}

export interface StudyHead {
  study: string;
  title: string;
  is_table: boolean;
  faults: string[];
}

export interface Column { name: string; what: string; standing: 'needed' | 'optional' | 'other'; usual: string | null }

export interface SheetData {
  name: string;
  version: string;
  fault: string | null;
  columns: Column[];
  rows: string[][];
}

export interface Key { key: string; value: string; example: string; rule: string; absence: string | null }

export interface StudyExperiment {
  experiment: string;
  description: string;
  value_name: string;
  unit: string;
  keys: Key[];
  measured: string;
  sheet: SheetData | null;
}

export interface Study extends StudyHead {
  hash?: string;
  version?: string;
  notes?: string[];
  sought?: {name: string; value: number | null; min: number; max: number}[];
  experiments?: StudyExperiment[];
}

export interface SheetCheck {
  faults: {row: number | null; column: number | null; text: string}[];
  notes: string[];
  readings: number;
  version?: string;
}

export interface NumbersCheck { faults: {key: string | null; text: string}[]; saved?: boolean }

export interface Task {
  study: string;
  task: 'calibrate' | 'plan' | 'estimate';
  state: 'waiting' | 'running' | 'stopping' | 'done' | 'stopped' | 'failed';
  command: string;
  seconds: number;
  end: string;
  lines: string[];
}

export interface Progress {
  stage: string;
  done: number;
  of: number;
  fraction: number;
  seconds: number;
  seconds_left: number | null;
  parameters: {name: string; bounds: [number, number]}[];
  rounds: {round: number; jobs: number; values: number[]; sd: number[]}[];
  notes: string[];
}

export interface FoundParameter {
  name: string;
  value: number | null;
  interval: [number, number] | null;
  verdict: string;
  bounds: [number, number] | null;
  advice: string;
}

export interface FoundReading {
  name: string;
  unit: string;
  measured: number | null;
  measured_uncertainty: number | null;
  simulated: number | null;
  simulated_uncertainty: number | null;
}

export interface Estimate {
  cores: number;
  budgets: {budget: string; description: string; seconds: number; experiments: {experiment: string; fit_runs: number; check_runs: number}[]}[];
}

type ByCoefficient = Record<string, number>;

export interface Plan {
  hash: string;
  readings: number;
  experiments: {experiment: string; measured: boolean; run_s: number | null; effects: ByCoefficient | null}[];
  now: {interval_widths: ByCoefficient; determined: ByCoefficient};
  steps: {experiment: string; interval_widths: ByCoefficient; determined: ByCoefficient}[];
  notes: string[];
}

export interface Calibration {
  study: string;
  folder: string;
  state: 'none' | 'running' | 'unfinished' | 'changed' | 'finished';
  is_elsewhere: boolean;
  runs: number;
  progress: Progress | null;
  result: {verdict: string | null; parameters: FoundParameter[]; observables: FoundReading[]} | null;
  estimate: Estimate | null;
  plan: Plan | null;
  files: {name: string; bytes: number}[];
  targets: {name: string; summary: string}[];
  tasks: Task[];
}

const of = (path: string, names: Record<string, string>) => `${path}?${new URLSearchParams(names)}`;
const sent = (method: string, json: unknown): RequestInit => ({method, body: JSON.stringify(json)});

export interface Cells { columns: string[]; rows: string[][]; version?: string }
export type Numbers = Record<string, Record<string, string>>;

export const studies = {
  list: () => asked<{studies: StudyHead[]}>('/api/studies'),
  form: () => asked<Form>('/api/new'),
  draft: (said: Said) => asked<Draft>('/api/new', sent('POST', said)),
  start: (said: Said) => asked<{study: string}>('/api/studies', sent('POST', said)),
  study: (study: string) => asked<Study>(of('/api/study', {study})),
  checkSheet: (study: string, experiment: string, cells: Cells) =>
    asked<SheetCheck>(of('/api/sheet', {study, experiment}), sent('POST', cells)),
  saveSheet: (study: string, experiment: string, cells: Cells) =>
    asked<SheetCheck>(of('/api/sheet', {study, experiment}), sent('PUT', cells)),
  checkNumbers: (study: string, numbers: Numbers) =>
    asked<NumbersCheck>(of('/api/numbers', {study}), sent('POST', {numbers})),
  saveNumbers: (study: string, numbers: Numbers, version: string) =>
    asked<NumbersCheck>(of('/api/numbers', {study}), sent('PUT', {numbers, version})),
  tasks: () => asked<{tasks: Task[]}>('/api/tasks'),
  calibration: (study: string) => asked<Calibration>(of('/api/calibration', {study})),
  startTask: (study: string, task: string, amount: string) =>
    asked<{tasks: Task[]}>(of('/api/tasks', {study, task, amount}), {method: 'POST'}),
  stopTask: (study: string, task: string) =>
    asked<{tasks: Task[]}>(of('/api/tasks', {study, task}), {method: 'DELETE'}),
  exported: (study: string, to: string, approximate: boolean) =>
    asked<{command: string; is_done: boolean; lines: string[]}>(of('/api/export', {study, to, approximate: approximate ? '1' : '0'}), {method: 'POST'}),
  reportAddress: (study: string) => of('/files/report', {study}),
  fileAddress: (study: string, name: string) => of('/files/calibration', {study, name}),
};

/** A task that is running, stopping, or waiting for those before it. */
export const isAtWork = (task: Task | null) => task !== null && ['running', 'stopping', 'waiting'].includes(task.state);

// "restitution, particle–wall" for contact.particle_wall.restitution.
export const coefficientName = (name: string) => {
  const [, pair = '', which = name] = name.split('.');
  return `${which.replaceAll('_', ' ')}, ${pair.replace('particle_', 'particle–')}`;
};

export const durationText = (seconds: number) =>
  seconds < 120 ? `${Math.ceil(seconds)} s` : seconds < 7200 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
