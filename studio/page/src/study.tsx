// Studies: selected from the folder or newly created; the selected one in steps from bench to report.
import {useCallback, useEffect, useState} from 'preact/hooks';
import {CalibrationView} from './calibration';
import {NewStudy} from './new_study';
import {PlanView} from './plan';
import {Bounds, Protocol, Sheet} from './sheet';
import type {Study, StudyHead, Task} from './study_api';
import {isAtWork, studies} from './study_api';
import {useLooking} from './watched';

type Step = 'bench' | 'plan' | 'calibration';

const kSteps: [Step, string][] = [['bench', '1. Readings'], ['plan', '2. Which experiments'], ['calibration', '3. Calibration']];
const kLookAgain_ms = 2000;

const StudyList = ({heads, tasks, chosen, choose, startNew}: {
  heads: StudyHead[]; tasks: Task[]; chosen: string | null; choose: (study: string) => void; startNew: () => void;
}) => (
  <nav class="studies" aria-label="Studies">
    <button type="button" class="main" aria-pressed={chosen === null} onClick={startNew}>New study</button>
    <ul>
      {heads.map((head) => {
        const task = tasks.find((one) => one.study === head.study && isAtWork(one));
        return (
          <li key={head.study}>
            <button type="button" aria-current={head.study === chosen} onClick={() => choose(head.study)}>
              <span class="name">{head.title}</span>
              <span class="hint">{head.study}</span>
              {task && <span class="badge ok">{task.state === 'waiting' ? 'waits' : 'at work'}</span>}
              {!task && head.faults.length > 0 && <span class="badge flagged">to fill in</span>}
            </button>
          </li>
        );
      })}
    </ul>
  </nav>
);

const Bench = ({study, reload}: {study: Study; reload: () => Promise<void>}) => (
  <div class="bench">
    {study.faults.length > 0 && (
      <section class="todo" aria-label="What is missing">
        <h3>Before it can be calibrated</h3>
        <ul>{study.faults.map((fault) => <li key={fault}>{fault}</li>)}</ul>
      </section>
    )}
    {study.experiments?.map((one) => (
      <section key={one.experiment} class="experiment" aria-label={one.experiment}>
        <h3>{one.experiment}: {one.value_name} [{one.unit}]</h3>
        <p class="hint">{one.description}</p>
        {one.sheet ? <Sheet study={study.study} experiment={one.experiment} sheet={one.sheet} reload={reload} />
          : <p class="hint">Measured: {one.measured}. {one.measured === 'nothing' ? 'Name a sheet in the study file.' : 'They are named in the study file.'}</p>}
        <Protocol study={study} experiment={one} reload={reload} />
      </section>
    ))}
    {study.sought && study.sought.length > 0 && <section class="experiment" aria-label="bounds"><Bounds study={study} reload={reload} /></section>}
    {study.notes?.map((note) => <p key={note} class="warning">{note}</p>)}
  </div>
);

const StudyView = ({name, tasks, refresh}: {name: string; tasks: Task[]; refresh: () => Promise<void>}) => {
  const [study, setStudy] = useState<Study | null>(null);
  const [step, setStep] = useState<Step>('bench');
  const [trouble, setTrouble] = useState('');
  const load = useCallback(async () => {
    try {
      setStudy(await studies.study(name));
      setTrouble('');
    } catch (error) {
      setTrouble((error as Error).message);
    }
    await refresh();
  }, [name]);
  useEffect(() => { void load(); }, [load]);
  if (!study) return <p role="status">{trouble || 'reading the study …'}</p>;
  return (
    <div class="study">
      <h2>{study.title}</h2>
      {trouble && <p class="trouble" role="alert">{trouble}</p>}
      {study.is_table && <p class="hint">Its runs are those of another program: <code>repose calibrate {study.study} --runs RUNS.csv</code> fits it on the command line.</p>}
      {!study.is_table && !study.experiments && (
        <section class="todo" aria-label="What is wrong"><h3>The study cannot be read</h3><ul>{study.faults.map((fault) => <li key={fault}>{fault}</li>)}</ul>
          <button type="button" onClick={() => void load()}>Read it again</button></section>
      )}
      {study.experiments && (
        <>
          <div class="views" role="group" aria-label="Step">
            {kSteps.map(([one, title]) => <button key={one} type="button" aria-pressed={one === step} onClick={() => setStep(one)}>{title}</button>)}
          </div>
          {step === 'bench' && <Bench study={study} reload={load} />}
          {step === 'plan' && <PlanView study={study} refresh={refresh} />}
          {step === 'calibration' && <CalibrationView study={study} tasks={tasks} refresh={refresh} />}
        </>
      )}
    </div>
  );
};

export const Studies = () => {
  const [heads, setHeads] = useState<StudyHead[] | null>(null);
  const [tasks, setTasks] = useState<Task[]>([]);
  const [chosen, setChosen] = useState<string | null>(null);
  const [trouble, setTrouble] = useState('');
  const refresh = useCallback(async () => {
    try {
      const [list, work] = [await studies.list(), await studies.tasks()];
      setHeads(list.studies);
      setTasks(work.tasks);
      setTrouble('');
    } catch (error) {
      setTrouble((error as Error).message);
    }
  }, []);
  useLooking(refresh, kLookAgain_ms);
  // The first study is shown as soon as there is known to be one.
  const [is_new, setIsNew] = useState(false);
  if (!heads) return <p role="status" class="empty">{trouble || 'looking for studies …'}</p>;
  const shown = is_new ? null : chosen ?? heads[0]?.study ?? null;
  const choose = (study: string) => { setChosen(study); setIsNew(false); };
  return (
    <div class="study-layout">
      <StudyList heads={heads} tasks={tasks} chosen={shown} choose={choose} startNew={() => setIsNew(true)} />
      <div class="study-main">
        {trouble && <p class="trouble" role="alert">{trouble}</p>}
        {shown === null ? <NewStudy started={async (study) => { await refresh(); choose(study); }} />
          : <StudyView key={shown} name={shown} tasks={tasks} refresh={refresh} />}
      </div>
    </div>
  );
};
