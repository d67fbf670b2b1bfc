// Hints for a picture: tools for the pointer, and the same as numbers for the keyboard.
import {useState} from 'preact/hooks';
import type {Box, Folder, Line, Place, Told} from './api';
import type {Brush, Tool} from './viewer';

const kSays: {says: Brush['says']; name: string}[] = [
  {says: 'heap', name: 'heap'}, {says: 'no_heap', name: 'not heap'}, {says: 'nothing', name: 'take back'},
];

const BrushTools = ({brush, setBrush}: {brush: Brush; setBrush: (brush: Brush) => void}) => (
  <div class="brush">
    <div role="radiogroup" aria-label="What the brush says" class="tools">
      {kSays.map(({says, name}) => (
        <button type="button" role="radio" aria-checked={brush.says === says} onClick={() => setBrush({...brush, says})}>{name}</button>
      ))}
    </div>
    <label>Brush {Math.round(100 * brush.width)} % of the height
      <input type="range" min="0.01" max="0.15" step="0.01" value={brush.width}
        onInput={({currentTarget}) => setBrush({...brush, width: currentTarget.valueAsNumber})} />
    </label>
  </div>
);

interface Props {
  told: Told;
  tool: Tool;
  folder: Folder;
  choose: (tool: Tool) => void;
  tell: (told: Told, ends: boolean) => void;
}

const kTools: {tool: Tool; name: string; help: string}[] = [
  {tool: 'move', name: 'Move', help: 'Drag the picture; the wheel makes it larger'},
  {tool: 'box', name: 'Box', help: 'Drag a box around the heap, feet included'},
  {tool: 'ground', name: 'Ground', help: 'Drag along the line that the heap stands on, or drag its ends'},
  {tool: 'keep', name: 'Keep', help: 'Click on what belongs to the heap'},
  {tool: 'drop', name: 'Drop', help: 'Click on what does not'},
  {tool: 'paint', name: 'Paint', help: 'Paint over what belongs to the heap, and over what does not'},
  {tool: 'exclude', name: 'Leave out', help: 'Drag a box over a hand, a timer or a label'},
  {tool: 'length', name: 'Length', help: 'Drag along a known length, then say how many mm it is'},
];

export const Toolbar = ({told, tool, choose, tell, brush, setBrush}: Props & {brush: Brush; setBrush: (brush: Brush) => void}) => (
  <div class="toolbar">
    <div role="radiogroup" aria-label="Tool" class="tools">
      {kTools.map(({tool: one, name, help}) => (
        <button type="button" role="radio" aria-checked={tool === one} title={help} onClick={() => choose(one)}>{name}</button>
      ))}
    </div>
    <button type="button" title="Turn the picture clockwise by 90°"
      onClick={() => tell({...told, rotate_deg: (told.rotate_deg + 90) % 360}, true)}>Turn 90°</button>
    {tool === 'paint' && <BrushTools brush={brush} setBrush={setBrush} />}
    {tool === 'length' && told.scale && (
      <label class="length">Its length in mm
        <input type="number" min="0" step="any" required value={told.scale.length_mm ?? ''}
          onInput={(event) => tell({...told, scale: {...told.scale!, length_mm: event.currentTarget.valueAsNumber || null}}, false)}
          onChange={() => tell(told, true)} />
      </label>
    )}
    <p class="hint">{kTools.find(({tool: one}) => one === tool)!.help}.</p>
  </div>
);

const numbersIn = (text: string) => text.split(/[\s,;]+/).filter((word) => word !== '').map(Number);

// Numbers separated by commas; reported when the field loses focus or Enter is pressed.
export const Numbers = ({label, value, counts, tell}:
    {label: string; value: number[]; counts: (n: number) => boolean; tell: (numbers: number[]) => void}) => {
  // The page may be redrawn while the user types.
  const [draft, setDraft] = useState<string | null>(null);
  const take = (input: HTMLInputElement) => {
    const numbers = numbersIn(input.value);
    const is_good = numbers.every(Number.isFinite) && (numbers.length === 0 || counts(numbers.length));
    input.setCustomValidity(is_good ? '' : `${label}: not numbers parted by commas, as many as asked for`);
    input.reportValidity();
    if (!is_good) return;
    setDraft(null);
    if (numbers.join() !== value.join()) tell(numbers);
  };
  return (
    <label>{label}
      <input type="text" inputMode="decimal" value={draft ?? value.join(', ')}
        onInput={(event) => setDraft(event.currentTarget.value)} onChange={(event) => take(event.currentTarget)} />
    </label>
  );
};

const inPairs = (numbers: number[]): Place[] =>
  numbers.flatMap((x, k) => (k % 2 === 0 ? [[x, numbers[k + 1]!] as Place] : []));
const inFours = (numbers: number[]): Box[] =>
  numbers.flatMap((_, k) => (k % 4 === 0 ? [numbers.slice(k, k + 4) as Box] : []));

const kIsFour = (n: number) => n === 4;

export const Fields = ({told, folder, tell}: Props) => {
  const set = (part: Partial<Told>) => tell({...told, ...part}, true);
  return (
    <details class="fields">
      <summary>As numbers</summary>
      <Numbers label="Box: x, y, width, height" value={told.heap ?? []} counts={kIsFour}
        tell={(n) => set({heap: n.length ? n as Box : null})} />
      <Numbers label="Ground: x1, y1, x2, y2" value={told.ground ?? []} counts={kIsFour}
        tell={(n) => set({ground: n.length ? n as Line : null})} />
      <Numbers label="Keep: x, y, x, y …" value={told.keep.flat()} counts={(n) => n % 2 === 0}
        tell={(n) => set({keep: inPairs(n)})} />
      <Numbers label="Drop: x, y, x, y …" value={told.drop.flat()} counts={(n) => n % 2 === 0}
        tell={(n) => set({drop: inPairs(n)})} />
      <Numbers label="Leave out: x, y, width, height …" value={told.exclude.flat()} counts={(n) => n % 4 === 0}
        tell={(n) => set({exclude: inFours(n)})} />
      <Numbers label="Length: x1, y1, x2, y2, mm" value={told.scale ? [...told.scale.line, ...(told.scale.length_mm === null ? [] : [told.scale.length_mm])] : []}
        counts={(n) => n === 5}
        tell={(n) => set({scale: n.length ? {line: n.slice(0, 4) as Line, length_mm: n[4]!} : null, board: n.length ? false : told.board})} />
      <Numbers label="Camera pitch, ° down" value={told.pitch_deg === null ? [] : [told.pitch_deg]} counts={(n) => n === 1}
        tell={(n) => set({pitch_deg: n[0] ?? null})} />
      <label>Flanks
        <select value={told.half ?? ''} onChange={(event) => set({half: (event.currentTarget.value || null) as Told['half']})}>
          <option value="">both</option>
          <option value="left">left alone: the right side is a wall</option>
          <option value="right">right alone: the left side is a wall</option>
        </select>
      </label>
      <label class="check">
        <input type="checkbox" checked={told.board} onChange={(event) => set({board: event.currentTarget.checked, scale: null})} />
        a printed board stands in the picture
      </label>
      <fieldset>
        <legend>To see what it changes; not saved</legend>
        <label>Definition
          <select value={told.definition ?? folder.definitions[0]!.name}
            onChange={(event) => set({definition: event.currentTarget.value})}>
            {folder.definitions.map(({name, description}) => <option value={name} title={description}>{name}</option>)}
          </select>
        </label>
        {([0, 1] as const).map((end) => (
          <label>{end === 0 ? 'Window from' : 'Window to'} {Math.round(100 * told.window[end])} % of the height
            <input type="range" min="0" max="1" step="0.01" value={told.window[end]} disabled={(told.definition ?? folder.definitions[0]!.name) !== folder.definitions[0]!.name}
              onInput={(event) => {
                const window: [number, number] = [...told.window];
                window[end] = Number(event.currentTarget.value);
                if (window[0] + 0.05 <= window[1]) tell({...told, window}, false);
              }}
              onChange={() => tell(told, true)} />
          </label>
        ))}
      </fieldset>
    </details>
  );
};
