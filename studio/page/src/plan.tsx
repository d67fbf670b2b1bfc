// Which experiment would determine which of a study's coefficients: `repose plan` as a picture.
import {useState} from 'preact/hooks';
import type {Plan, Study} from './study_api';
import {coefficientName, isAtWork, studies} from './study_api';
import {useCalibration} from './watched';

const kSeen = 1;  // in uncertainties; less counts as no effect (docs/between-grains.md)
const kEnough = .8;  // fraction of the materials, as in the command's table

// The circles' areas grow with the effects; the numbers stand beside them.
const Effects = ({plan, names}: {plan: Plan; names: string[]}) => {
  const most = Math.max(kSeen, ...plan.experiments.flatMap(({effects}) => Object.values(effects ?? {})));
  return (
    <div class="scrolled" tabIndex={0} role="region" aria-label="What each experiment tells">
      <table class="effects">
        <caption>What each experiment tells: by how many of its uncertainties its mean reading changes from bound to bound, with {plan.readings} readings</caption>
        <thead><tr><th scope="col">experiment</th>{names.map((name) => <th key={name} scope="col">{coefficientName(name)}</th>)}<th scope="col">a run</th></tr></thead>
        <tbody>
          {plan.experiments.map((one) => (
            <tr key={one.experiment}>
              <th scope="row">{one.experiment.replaceAll('_', ' ')}{one.measured && <span class="badge ok">measured</span>}</th>
              {names.map((name) => {
                const effect = one.effects?.[name] ?? 0;
                return (
                  <td key={name}>{effect < kSeen ? <span class="hint">–</span> : (
                    <span class="effect"><svg viewBox="0 0 40 40" aria-hidden="true"><circle cx="20" cy="20" r={4 + 15 * Math.sqrt(effect / most)} /></svg>{effect < 9.95 ? effect.toFixed(1) : effect.toFixed(0)}</span>
                  )}</td>
                );
              })}
              <td class="hint">{one.run_s === null ? '–' : `${one.run_s.toPrecision(2)} s`}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
};

const Bar = ({width, is_enough}: {width: number; is_enough: boolean}) => (
  <span class={is_enough ? 'width enough' : 'width'}>
    <svg viewBox="0 0 100 12" preserveAspectRatio="none" aria-hidden="true"><rect class="all" width="100" height="12" /><rect class="part" width={100 * Math.min(1, width)} height="12" /></svg>
    {Math.round(100 * width)} %{is_enough ? '' : ' open'}
  </span>
);

const Outlook = ({plan, names}: {plan: Plan; names: string[]}) => {
  const rows = [{experiment: plan.experiments.some(({measured}) => measured) ? 'what is measured' : 'nothing measured', ...plan.now},
    ...plan.steps.map((step) => ({...step, experiment: `+ ${step.experiment.replaceAll('_', ' ')}`}))];
  return (
    <div class="scrolled" tabIndex={0} role="region" aria-label="What is to be expected">
      <table class="outlook">
        <caption>Width of the 95 % interval to be expected, in parts of the distance of the bounds; open: it would not be determined in more than one material of five</caption>
        <thead><tr><th scope="col">with</th>{names.map((name) => <th key={name} scope="col">{coefficientName(name)}</th>)}</tr></thead>
        <tbody>{rows.map((row) => (
          <tr key={row.experiment}><th scope="row">{row.experiment}</th>
            {names.map((name) => <td key={name}><Bar width={row.interval_widths[name] ?? 1} is_enough={(row.determined[name] ?? 0) >= kEnough} /></td>)}</tr>
        ))}</tbody>
      </table>
      {plan.steps.length === 0 && <p class="hint">No further experiment would tell much more.</p>}
    </div>
  );
};

export const PlanView = ({study, refresh}: {study: Study; refresh: () => Promise<void>}) => {
  const {state, trouble, act} = useCalibration(study.study, refresh);
  const [minutes, setMinutes] = useState('15');
  if (!state) return <p role="status">{trouble || 'one moment …'}</p>;
  const task = state.tasks.find((one) => one.task === 'plan') ?? null;
  const is_at_work = isAtWork(task);
  const plan = state.plan;
  const names = plan ? Object.keys(plan.now.interval_widths) : [];
  return (
    <div class="plan">
      <p class="hint">Before you go to the bench: every experiment that repose knows is simulated all over the bounds, to see which would determine the coefficients. A calibration uses these simulations.</p>
      {trouble && <p class="trouble" role="alert">{trouble}</p>}
      <div class="actions">
        {!is_at_work && (
          <>
            <label class="check">Time on one core
              <select value={minutes} onChange={(event) => setMinutes(event.currentTarget.value)}>
                <option value="1">1 minute: cheap experiments</option>
                <option value="15">15 minutes</option>
                <option value="60">60 minutes</option>
              </select>
            </label>
            <button type="button" class={plan ? '' : 'main'} onClick={() => void act(studies.startTask(study.study, 'plan', minutes))}>{plan ? 'Plan again' : 'Find out'}</button>
          </>
        )}
        {task && is_at_work && <><button type="button" disabled={task.state === 'stopping'} onClick={() => void act(studies.stopTask(study.study, 'plan'))}>Stop</button>
          <span role="status">{task.state === 'waiting' ? 'waits' : task.state === 'stopping' ? 'stops in good order …' : `at work for ${Math.round(task.seconds)} s: ${task.lines[task.lines.length - 1] ?? ''}`}</span></>}
      </div>
      {task?.state === 'failed' && <section class="ended" aria-label="How it ended">{task.lines.map((line) => <p key={line} class="reason">{line}</p>)}</section>}
      {plan && plan.hash !== study.hash && <p class="warning">The study or its readings were changed since this plan was made.</p>}
      {plan && <Effects plan={plan} names={names} />}
      {plan && <Outlook plan={plan} names={names} />}
      {plan?.notes.map((note) => <p key={note} class="hint">{note}</p>)}
      <section class="command" aria-label="The same on the command line"><h3>The same on the command line</h3><code>repose plan {study.study} --minutes {minutes}</code></section>
    </div>
  );
};
