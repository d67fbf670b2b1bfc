// The page: files on the left, the selected one in the middle, its results beside it; or all as a set.
import {render} from 'preact';
import {useEffect, useState} from 'preact/hooks';
import {api} from './api';
import {useEdit} from './edit';
import {Files} from './files';
import type {Filmed} from './film';
import {FilmView, FilmedChoice, filmedByName} from './film';
import {useFolder} from './folder';
import {Result} from './result';
import {SetView} from './set';
import {Studies} from './study';
import {Fields, Toolbar} from './tools';
import type {Brush, Tool} from './viewer';
import {Viewer} from './viewer';

const App = () => {
  const [chosen, setChosen] = useState<string | null>(null);
  const {folder, answers, errors, marks, trouble, setTrouble, look, take} = useFolder(chosen);
  const [is_set, setIsSet] = useState(false);
  const [is_study, setIsStudy] = useState(false);
  const [tool, setTool] = useState<Tool>('move');
  const [brush, setBrush] = useState<Brush>({says: 'heap', width: 0.04});
  const [is_over, setIsOver] = useState(false);
  const [filmed, setFilmed] = useState(new Map<string, Filmed>());  // the user's choice for each film
  const files = folder?.files ?? [];
  const entry = files.find(({file}) => file === chosen) ?? files[0] ?? null;
  const known = entry ? answers.get(entry.file) : undefined;
  // Lines and outline are kept only for the file in view.
  const answer = !known?.told ? known
    : marks?.file === entry!.file && marks.version === known.version ? {...known, marks: marks.marks} : undefined;
  const {current, tell, undo, save, forget, drop, keep} = useEdit(entry, answer, setTrouble, look, take);
  const shown = current?.answer ?? answer;
  const told = current?.told ?? answer?.told ?? null;
  const shows = entry?.kind === 'film' ? filmed.get(entry.file) ?? filmedByName(entry.file) : 'heap';
  const chooseFilmed = (one: Filmed) => setFilmed((before) => new Map(before).set(entry!.file, one));
  const is_told_here = !!told && !answer?.measured.camera;
  const choose = (file: string) => { setChosen(file); setIsSet(false); setTrouble(''); };

  const add = async (list: FileList | null) => {
    const refused: string[] = [];
    for (const file of list ?? []) {
      try {
        if (file.size > folder!.largest_upload_bytes) {
          throw new Error(`${file.name}: it is larger than ${folder!.largest_upload_bytes >> 20} MB. Fix: copy it into the folder.`);
        }
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
        <p class="folder" title={folder.folder}>{folder.name}</p>
        <div class="views" role="group" aria-label="View">
          <button type="button" aria-pressed={!is_set && !is_study} onClick={() => { setIsSet(false); setIsStudy(false); }}>Pictures</button>
          <button type="button" aria-pressed={is_set && !is_study} onClick={() => { setIsSet(true); setIsStudy(false); }}>All as a set</button>
          <button type="button" aria-pressed={is_study} onClick={() => setIsStudy(true)}>Study</button>
        </div>
        <label class="add">Add pictures
          <input type="file" multiple onChange={(event) => { void add(event.currentTarget.files); event.currentTarget.value = ''; }} />
        </label>
      </header>
      {trouble && <p class="trouble" role="alert">{trouble}</p>}
      {is_study && <main><Studies /></main>}
      {!is_study && current?.is_behind && (
        <div class="trouble" role="alert">
          <p>{current.file} was changed in another window, or by a command, while you corrected it.</p>
          <p class="actions">
            <button type="button" onClick={drop}>Show what was saved</button>
            <button type="button" onClick={keep}>Keep mine</button>
          </p>
        </div>
      )}
      {!is_study && files.length === 0 && !is_set && <main class="empty"><p>There are no pictures in this folder yet. Drop some onto this page, or add them above.</p></main>}
      {is_set && !is_study && <main><SetView folder={folder} files={files} answers={answers} choose={choose} /></main>}
      {!is_study && entry && !is_set && (
        <main class="pictures">
          <Files files={files} answers={answers} errors={errors} filmed={filmed} chosen={entry.file} choose={choose} />
          {shows !== 'heap' && <FilmView key={`${entry.file} ${shows}`} entry={entry} experiment={shows} choose={chooseFilmed} />}
          {shows === 'heap' && <section class="picture" aria-label={entry.file}>
            <h2>{entry.file}</h2>
            {entry.kind === 'film' && <FilmedChoice filmed="heap" choose={chooseFilmed} />}
            {told && is_told_here && <Toolbar key={entry.file} told={told} tool={tool} folder={folder} choose={setTool} tell={tell} brush={brush} setBrush={setBrush} />}
            {answer && !is_told_here && told && <p class="hint">It is measured with a camera file: correct it on the command line.</p>}
            {shown ? <Viewer entry={entry} marks={shown.marks} told={told} tool={is_told_here ? tool : 'move'} brush={brush} tell={tell} />
              : <p role="status">{errors.get(entry.file) ?? 'measuring …'}</p>}
          </section>}
          {shows === 'heap' && shown && (
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
