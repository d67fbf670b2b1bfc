// The program's answers about films of drops, rolls and tilts, as in `repose track --json`.
import type {FileEntry, Line} from './api';
import {asked} from './api';

export type Experiment = 'drop' | 'roll' | 'tilt';

export interface Bounce {
  number: number;
  time_s: number;
  restitution: number;
  restitution_uncertainty: number;
  drop_mm: number;
  drop_uncertainty_mm: number;
  rebound_mm: number;
  rebound_uncertainty_mm: number;
}

export interface Roll {
  stopped_mm: number;
  stopped_uncertainty_mm: number;
  released_mm: number;
  released_uncertainty_mm: number;
  incline_deg: number;
  incline_uncertainty_deg: number;
  stopped_s: number;
}

export interface Tilt {
  angle_deg: number;
  angle_uncertainty_deg: number;
  rate_deg_s: number;
  rate_uncertainty_deg_s: number;
  onset_s: number;
}

export interface Tracked {
  experiment: Experiment;
  status: 'ok' | 'flagged' | 'refused';
  reason?: string;
  warnings: {code: string; message: string}[];
  bounces?: Bounce[];
  unread_bounces?: {number: number; time_s: number | null}[];
  roll?: Roll | null;
  tilt?: Tilt | null;
  track: {path: [number, number, number][]} | null;  // time in s, position of the grain in pixels
}

export interface TrackAnswer {
  number: number;
  tracked: Tracked;
  command: string;
}

// The user's hints for a film; positions in its pixels.
export interface FilmTold {
  experiment: Experiment;
  scale: {line: Line; length_mm: number} | null;
  board: boolean;
  released_mm: number | null;
}

export interface FilmFrames {
  width: number;
  height: number;
  times_s: number[];
}

const of = (path: string, names: Record<string, string>) => `${path}?${new URLSearchParams(names)}`;

export const films = {
  frames: (file: string) => asked<FilmFrames>(of('/api/film', {file})),
  frame: (entry: FileEntry, number: number) => of('/api/film/frame', {file: entry.file, version: entry.version, number: `${number}`}),
  track: (file: string, told: FilmTold) => asked<TrackAnswer>(of('/api/film/track', {file}), {method: 'POST', body: JSON.stringify(told)}),
  overlay: (number: number) => of('/api/film/overlay', {number: `${number}`}),
  toSheet: (number: number, study: string, bounces: number[]) =>
    asked<{sheet: string; rows: number; notes: string[]}>(of('/api/film/readings', {number: `${number}`, study}), {method: 'POST', body: JSON.stringify({bounces})}),
};
