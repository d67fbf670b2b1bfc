// The program's answers: its results, as in its JSON files (docs/json.md), and what the page draws.
// Nothing is computed here that the program computes.

export type Box = [number, number, number, number];
export type Line = [number, number, number, number];
export type Place = [number, number];

// A stroke of a round brush.
export interface BrushStroke {
  says: 'heap' | 'no_heap' | 'nothing';
  width: number;
  path: Place[];
}

// The user's hints for a picture; positions in pixels of the rotated picture.
export interface Told {
  rotate_deg: number;
  heap: Box | null;
  half: 'left' | 'right' | null;
  ground: Line | null;
  keep: Place[];
  drop: Place[];
  exclude: Box[];
  scale: {line: Line; length_mm: number | null} | null;  // null: not given yet
  board: boolean;
  pitch_deg: number | null;
  window: [number, number];
  definition: string | null;
  has_mask: boolean;  // saved; strokes are painted over it
  painted: BrushStroke[];
}

export interface Side {
  status: string;
  angle_deg: number | null;
  uncertainty_deg: number | null;
  reason?: string;
}

export interface Measured {
  file: string;
  status: 'ok' | 'flagged' | 'refused';
  angle_deg: number | null;
  uncertainty_deg: number | null;
  left: Side | null;
  right: Side | null;
  definition: string | null;
  window: [number, number] | null;
  warnings: {code: string; message: string}[];
  reason?: string;
  mm_per_px: number | null;
  height_mm: number | null;
  height_mm_uncertainty: number | null;
  base_mm: number | null;
  base_mm_uncertainty: number | null;
  camera: unknown;
}

export interface SideMarks {
  line: Line | null;
  apron_line: Line | null;
}

export interface Marks {
  width: number;
  height: number;
  outline: Place[];
  ground: Line | null;
  left: SideMarks;
  right: SideMarks;
}

export interface Answer {
  version: string;
  measured: Measured;
  told: Told | null;  // null for scans and particle files
  marks: Marks | null;
  command: string;
  proposed: Told | null;
}

export interface FileEntry {
  file: string;
  kind: 'picture' | 'film' | 'scan' | 'particles';
  version: string;
  has_hints: boolean;
}

export interface Folder {
  folder: string;
  name: string;
  program: string;
  command: string;  // that measures the whole folder
  largest_upload_bytes: number;
  definitions: {name: string; description: string}[];
  files: FileEntry[];
}

export interface Mean {
  n: number;
  mean_deg: number | null;
  sd_deg: number | null;
  interval_deg: [number, number] | null;
}

export interface SetSummary extends Mean {
  ok: Mean;
  all: Mean;
  flagged: number;
  refused: number;
  not_read: number;
  copies: number;
  outliers: {file: string; angle_deg: number; score: number; counted: boolean}[];
}

// One side of a comparison: a folder within this one, or some of its files.
export type SetOfHeaps = {folder: string} | {files: string[]};

export interface HeapFolders {
  folders: {folder: string; kind: string; heaps: number}[];
  margin_deg: number;
}

// As in `repose compare --json` for two sets.
export interface Comparison {
  sets: {name: string; n: number; mean_deg: number | null; sd_deg: number | null; interval_deg: [number, number] | null;
    heaps: {file: string; angle_deg: number | null}[]}[];
  angle_difference_deg: number | null;
  angle_difference_interval: [number, number] | null;
  verdict: string;
  margin_deg: number;
  iou: number | null;
  heaps_to_tell: number | null;
  warnings: {code: string; message: string}[];
}

export interface Compared {
  number: number;
  comparison: Comparison;
  has_figure: boolean;
  notes: string[];
  command: string;
}

export const asked = async <T>(address: string, options: RequestInit = {}): Promise<T> => {
  let response: Response;
  try {
    response = await fetch(address, options);
  } catch {
    throw new Error('repose studio does not answer: it has ended. Start it again, and open its new address.');
  }
  const text = await response.text();
  if (response.status === 403) throw new Error(text);
  const json = JSON.parse(text) as T & {error?: string};
  if (!response.ok) throw new Error(json.error ?? `the studio answered ${response.status}`);
  return json;
};

const named = (path: string, file: string) => `${path}?file=${encodeURIComponent(file)}`;

const versioned = (path: string, file: string, version: string) => `${named(path, file)}&version=${encodeURIComponent(version)}`;

// A line whose length is not given yet is not a scale.
const sent = (told: Told) => JSON.stringify(told.scale?.length_mm === null ? {...told, scale: null} : told);

export const api = {
  folder: () => asked<Folder>('/api/folder'),
  set: () => asked<SetSummary>('/api/set'),
  measured: (file: string) => asked<Answer>(named('/api/measured', file)),
  measure: (file: string, told: Told) =>
    asked<Answer>(named('/api/measure', file), {method: 'POST', body: sent(told)}),
  // Both are refused if the file, or what is saved beside it, is no longer of that version.
  save: (file: string, told: Told, version: string) =>
    asked<Answer>(versioned('/api/hints', file, version), {method: 'PUT', body: sent(told)}),
  forget: (file: string, version: string) => asked<Answer>(versioned('/api/hints', file, version), {method: 'DELETE'}),
  add: (file: File) => asked<{file: string}>(named('/api/file', file.name), {method: 'POST', body: file}),
  // The version makes the browser fetch a changed picture again.
  picture: (entry: FileEntry, side: number, rotate_deg: number) =>
    `${versioned('/api/picture', entry.file, entry.version)}&side=${side}&turns=${rotate_deg / 90}`,
  sets: () => asked<HeapFolders>('/api/sets'),
  compare: (first: SetOfHeaps, second: SetOfHeaps, margin_deg: number) =>
    asked<Compared>('/api/comparison', {method: 'POST', body: JSON.stringify({first, second, margin_deg})}),
  // As drawn by `repose compare --overlay`.
  comparisonFigure: (number: number, width: number) => `/files/comparison.png?number=${number}&width=${width}`,
  comparisonNumbers: (number: number) => `/files/comparison.json?number=${number}`,
  mask: (file: string, version: string) => versioned('/api/mask', file, version),
  overlay: (file: string) => named('/api/overlay', file),
};
