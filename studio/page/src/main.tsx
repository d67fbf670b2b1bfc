// The page: files on the left, the chosen one in the middle, what was measured beside it; or all as a set.
import {render} from 'preact';
import {useCallback, useEffect, useRef, useState} from 'preact/hooks';
import type {Answer, Folder, Told} from './api';
import {api} from './api';
import {Files} from './files';
import {Result} from './result';
import {SetView} from './set';
import {Fields, Toolbar} from './tools';
import type {Tool} from './viewer';
import {Viewer} from './viewer';

const kLookAgain_ms = 3000;

// A picture that is being corrected. `told` is ahead of `answer` while it is measured.
interface Edit {
  file: string;
  told: Told;
  answer: Answer;
  past: Told[];  // for undo
}

// All files, measured one after the other; again when their version changes.
const useFolder = () => {
  const [folder, setFolder] = useState<Folder | null>(null);
  const [answers, setAnswers] = useState(new Map<string, Answer>());
  const [errors, setErrors] = useState(new Map<string, string>());
  const [trouble, setTrouble] = useState('');
  const known = useRef(new Map<string, string>());  // versions that were measured
  const is_busy = useRef(false);

  const look = useCallback(async () => {
    if (is_busy.current) return;
    is_busy.current = true;
    try {
      const now = await api.folder();
      setFolder(now);
      setTrouble('');
      for (const {file, version} of now.files) {
        if (known.current.get(file) === version) continue;
        known.current.set(file, version);
        try {
          const answer = await api.measured(file);
          setAnswers((before) => new Map(before).set(file, answer));
          setErrors((before) => { const after = new Map(before); after.delete(file); return after; });
        } catch (error) {
          setErrors((before) => new Map(before).set(file, (error as Error).message));
        }
      }
    } catch (error) {
      setTrouble((error as Error).message);
    } finally {
      is_busy.current = false;
    }
  }, []);
  useEffect(() => {
    void look();
    const timer = setInterval(() => { if (!document.hidden) void look(); }, kLookAgain_ms);
    return () => clearInterval(timer);
  }, [look]);
  const take = (file: string, answer: Answer) => setAnswers((before) => new Map(before).set(file, answer));
  return {folder, answers, errors, trouble, setTrouble, look, take};
};

// Corrections of the chosen picture: measured as they are made, undone, saved.
const useEdit = (file: string | null, answer: Answer | undefined, setTrouble: (text: string) => void,
    take: (file: string, answer: Answer) => void) => {
  const [edit, setEdit] = useState<Edit | null>(null);
  const waiting = useRef<{file: string; told: Told} | null>(null);
  const is_measuring = useRef(false);
  const current = edit && edit.file === file ? edit : null;

  // One at a time; of those that come meanwhile the newest is next.
  const measure = async () => {
    if (is_measuring.current) return;
    is_measuring.current = true;
    while (waiting.current) {
      const job = waiting.current;
      waiting.current = null;
      try {
        const found = await api.measure(job.file, job.told);
        setEdit((before) => (before && before.file === job.file ? {...before, answer: found} : before));
        setTrouble('');
      } catch (error) {
        setTrouble((error as Error).message);
      }
    }
    is_measuring.current = false;
  };
  const ask = (told: Told) => {
    waiting.current = {file: file!, told};
    void measure();
  };
  // What a drag began with: one step to undo, however many it was measured in.
  const began = useRef<Told | null>(null);
  const tell = (told: Told, ends: boolean) => {
    if (!file || !answer?.told) return;
    const before = current ?? {file, told: answer.told, answer, past: []};
    began.current ??= before.told;
    const past = ends ? [...before.past, began.current] : before.past;
    if (ends) began.current = null;
    setEdit({...before, told, past});
    ask(told);
  };
  const undo = () => {
    if (!current || current.past.length === 0) return;
    const told = current.past[current.past.length - 1]!;
    setEdit({...current, told, past: current.past.slice(0, -1)});
    ask(told);
  };
  const keep = async (work: () => Promise<Answer>) => {
    try {
      const found = await work();
      waiting.current = null;
      take(file!, found);
      setEdit(null);
      setTrouble('');
    } catch (error) {
      setTrouble((error as Error).message);
    }
  };
  const save = () => void keep(() => api.save(file!, current!.told));
  const forget = () => void keep(() => api.forget(file!));
  return {current, tell, undo, save, forget};
};

const App = () => {
  const {folder, answers, errors, trouble, setTrouble, look, take} = useFolder();
  const [chosen, setChosen] = useState<string | null>(null);
  const [is_set, setIsSet] = useState(false);
  const [tool, setTool] = useState<Tool>('move');
  const [is_over, setIsOver] = useState(false);
  const files = folder?.files ?? [];
  const entry = files.find(({file}) => file === chosen) ?? files[0] ?? null;
  const answer = entry ? answers.get(entry.file) : undefined;
  const {current, tell, undo, save, forget} = useEdit(entry?.file ?? null, answer, setTrouble, take);
  const shown = current?.answer ?? answer;
  const told = current?.told ?? answer?.told ?? null;
  const is_told_here = !!told && !answer?.measured.camera;
  const choose = (file: string) => { setChosen(file); setIsSet(false); };

  const add = async (list: FileList | null) => {
    const refused: string[] = [];
    for (const file of list ?? []) {
      try {
        setChosen((await api.add(file)).file);
        await look();
      } catch (error) {
        refused.push((error as Error).message);
      }
    }
    setTrouble(refused.join('\n'));
  };
  useEffect(() => {
    const press = (event: KeyboardEvent) => {
      if ((event.ctrlKey || event.metaKey) && event.key === 'z' && !(event.target instanceof HTMLInputElement)) {
        event.preventDefault();
        undo();
      }
    };
    addEventListener('keydown', press);
    return () => removeEventListener('keydown', press);
  });

  if (!folder) return <main class="empty"><h1>repose studio</h1><p role="status">{trouble || 'looking into the folder …'}</p></main>;
  return (
    <div class={is_over ? 'studio over' : 'studio'}
      onDragOver={(event) => { event.preventDefault(); setIsOver(true); }}
      onDragLeave={() => setIsOver(false)}
      onDrop={(event) => { event.preventDefault(); setIsOver(false); void add(event.dataTransfer?.files ?? null); }}>
      <header>
        <h1>repose studio</h1>
        <p class="folder">{folder.folder}</p>
        <div class="views" role="group" aria-label="View">
          <button type="button" aria-pressed={!is_set} onClick={() => setIsSet(false)}>Pictures</button>
          <button type="button" aria-pressed={is_set} onClick={() => setIsSet(true)}>All as a set</button>
        </div>
        <label class="add">Add pictures
          <input type="file" multiple onChange={(event) => { void add(event.currentTarget.files); event.currentTarget.value = ''; }} />
        </label>
      </header>
      {trouble && <p class="trouble" role="alert">{trouble}</p>}
      {files.length === 0 && <main class="empty"><p>There are no pictures in this folder yet. Drop some onto this page, or add them above.</p></main>}
      {files.length > 0 && is_set && <main><SetView folder={folder.folder} files={files} answers={answers} choose={choose} /></main>}
      {entry && !is_set && (
        <main class="pictures">
          <Files files={files} answers={answers} errors={errors} chosen={entry.file} choose={choose} />
          <section class="picture" aria-label={entry.file}>
            <h2>{entry.file}</h2>
            {told && is_told_here && <Toolbar key={entry.file} told={told} tool={tool} folder={folder} choose={setTool} tell={tell} />}
            {answer && !is_told_here && told && <p class="hint">It is measured with a camera file: correct it on the command line.</p>}
            {shown ? <Viewer entry={entry} marks={shown.marks} told={told} tool={is_told_here ? tool : 'move'} tell={tell} />
              : <p role="status">{errors.get(entry.file) ?? 'measuring …'}</p>}
          </section>
          {shown && (
            <aside>
              <Result answer={shown} definitions={folder.definitions} has_changes={!!current} needs_length={told?.scale?.length_mm === null} is_saved={entry.has_hints} is_told_here={is_told_here}
                can_undo={(current?.past.length ?? 0) > 0} undo={undo} save={save} forget={forget}
                propose={() => shown.proposed && tell(shown.proposed, true)} />
              {told && is_told_here && <Fields key={entry.file} told={told} tool={tool} folder={folder} choose={setTool} tell={tell} />}
            </aside>
          )}
        </main>
      )}
      <footer>{folder.program}</footer>
    </div>
  );
};

render(<App />, document.getElementById('studio')!);
