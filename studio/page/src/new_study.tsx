// A new study, as with `repose new`: values left empty are typical of the grain.
import {useEffect, useRef, useState} from 'preact/hooks';
import type {Draft, Form, Said} from './study_api';
import {studies} from './study_api';

const kPause_ms = 200;  // after the last key, before checking

const Faults = ({draft, field}: {draft: Draft | null; field: string}) => (
  <>{draft?.faults.filter((fault) => fault.field === field).map(({text}) => <span key={text} class="fault">{text}</span>)}</>
);

const usual = (draft: Draft | null, key: 'grain_mm' | 'tube_mm', place: number) => draft?.usual[key][place]?.toString() ?? '';

export const NewStudy = ({started}: {started: (study: string) => Promise<void>}) => {
  const [form, setForm] = useState<Form | null>(null);
  const [said, setSaid] = useState<Said | null>(null);
  const [draft, setDraft] = useState<Draft | null>(null);
  const [is_named, setIsNamed] = useState(false);  // no error for a name that has not been typed yet
  const [trouble, setTrouble] = useState('');
  const newest = useRef(0);

  useEffect(() => {
    void studies.form().then((asked) => {
      setForm(asked);
      setSaid({study: '', grains: asked.usual_grain, plate: asked.usual_plate, grain_mm: ['', '', ''], density_kg_m3: '', tube_mm: ['', ''],
        experiments: asked.experiments.filter(({is_default}) => is_default).map(({name}) => name)});
    }, (error) => setTrouble((error as Error).message));
  }, []);
  useEffect(() => {
    if (!said) return;
    const number = ++newest.current;
    const timer = setTimeout(() => {
      studies.draft(said).then((made) => { if (number === newest.current) setDraft(made); }, (error) => setTrouble((error as Error).message));
    }, kPause_ms);
    return () => clearTimeout(timer);
  }, [said]);

  if (!form || !said) return <p role="status">{trouble || 'one moment …'}</p>;
  const say = (change: Partial<Said>) => { setSaid({...said, ...change} as Said); setTrouble(''); };
  const at = (key: 'grain_mm' | 'tube_mm', place: number, text: string) => say({[key]: said[key].map((old, k) => (k === place ? text : old))});
  const grain = form.grains.find(({name}) => name === said.grains);
  const chosen = form.experiments.filter(({name}) => said.experiments.includes(name));
  const parts = form.parts.filter((part) => chosen.some((one) => one.parts.includes(part)));
  const toggle = (name: string) =>
    say({experiments: said.experiments.includes(name) ? said.experiments.filter((one) => one !== name) : [...said.experiments, name]});
  const start = async (event: Event) => {
    event.preventDefault();
    setIsNamed(true);
    try {
      await started((await studies.start(said)).study);
    } catch (error) {
      setTrouble((error as Error).message);
    }
  };
  return (
    <form class="new-study" onSubmit={(event) => void start(event)}>
      <h2>New study</h2>
      <p class="hint">A study says what the grains are, how they were tested, and which coefficients are sought. What you leave empty is taken from what is typical of the grain, and marked as assumed in the study file.</p>
      <label>Name of the study
        <input type="text" name="study" value={said.study} placeholder="peas" autocomplete="off"
          onInput={(event) => say({study: event.currentTarget.value})} onBlur={() => setIsNamed(said.study !== '')} />
        {(is_named || said.study !== '') && <Faults draft={draft} field="study" />}
      </label>
      <fieldset>
        <legend>The grains</legend>
        <div class="row">
          <label>Kind
            <select name="grains" value={said.grains} onChange={(event) => say({grains: event.currentTarget.value})}>
              {form.grains.map(({name}) => <option key={name} value={name}>{name}</option>)}
            </select>
          </label>
          {['Length', 'Width', 'Thickness'].map((name, k) => (
            <label key={name}>{name} [mm]
              <input type="text" inputMode="decimal" name={name.toLowerCase()} value={said.grain_mm[k]} placeholder={usual(draft, 'grain_mm', k)} onInput={(event) => at('grain_mm', k, event.currentTarget.value)} />
            </label>
          ))}
          <label>Density of a grain [kg/m³]
            <input type="text" inputMode="decimal" name="density" value={said.density_kg_m3} placeholder={draft?.usual.density_kg_m3.toString() ?? ''} onInput={(event) => say({density_kg_m3: event.currentTarget.value})} />
          </label>
        </div>
        <Faults draft={draft} field="kind of grain" /><Faults draft={draft} field="size" /><Faults draft={draft} field="density" />
        {grain && (
          <details>
            <summary>Between which bounds coefficients are sought</summary>
            <table>
              <thead><tr><th scope="col">coefficient</th><th scope="col">grain on plate</th><th scope="col">grain on grain</th></tr></thead>
              <tbody>
                {(['restitution', 'sliding_friction', 'rolling_friction'] as const).map((name) => (
                  <tr key={name}><th scope="row">{name.replace('_', ' ')}</th><td>{grain.with_wall[name].join(' – ')}</td><td>{grain.with_grain[name].join(' – ')}</td></tr>
                ))}
              </tbody>
            </table>
            <p class="hint">{grain.source ? `From the literature: ${grain.source}.` : 'Wide enough for any dry grain: there is no literature on this kind here. Narrow them in the study file if you know better.'}</p>
          </details>
        )}
      </fieldset>
      <fieldset>
        <legend>Experiments that you can do</legend>
        <div class="choices">
          {form.experiments.map((one) => (
            <label key={one.name} class="choice">
              <input type="checkbox" name={one.name} checked={said.experiments.includes(one.name)} onChange={() => toggle(one.name)} />
              <span><b>{one.name.replaceAll('_', ' ')}</b>: {one.value_name} [{one.unit}]<small>{one.description}</small></span>
            </label>
          ))}
        </div>
        {chosen.length === 0 && <span class="fault">None is chosen: the usual ones will be taken.</span>}
        <Faults draft={draft} field="experiments" />
      </fieldset>
      <fieldset>
        <legend>The bench</legend>
        <div class="row">
          <label>Plate
            <select name="plate" value={said.plate} onChange={(event) => say({plate: event.currentTarget.value})}>
              {form.plates.map((name) => <option key={name} value={name}>{name}</option>)}
            </select>
          </label>
          {parts.map((part) => (
            <label key={part}>{part[0]!.toUpperCase() + part.slice(1)}
              <select name={part} value={(said[part] as string) ?? ''} onChange={(event) => say({[part]: event.currentTarget.value})}>
                <option value="">as the plate</option>
                {form.plates.map((name) => <option key={name} value={name}>{name}</option>)}
              </select>
            </label>
          ))}
          {chosen.some((one) => one.has_tube || one.parts.includes('tube')) && ['Tube, inner diameter', 'Tube, height'].map((name, k) => (
            <label key={name}>{name} [mm]
              <input type="text" inputMode="decimal" value={said.tube_mm[k]} placeholder={usual(draft, 'tube_mm', k)} onInput={(event) => at('tube_mm', k, event.currentTarget.value)} />
            </label>
          ))}
        </div>
        {['plate', 'size of the tube', ...form.parts].map((field) => <Faults key={field} draft={draft} field={field} />)}
      </fieldset>
      {draft && <p class="hint">Assumed until you say otherwise: {draft.assumed.join(', ')}.</p>}
      {draft?.warning && <p class="warning">{draft.warning}</p>}
      {trouble && <p class="trouble" role="alert">{trouble}</p>}
      <div class="actions"><button type="submit" class="main">Start the study</button></div>
      {draft && <section class="command" aria-label="The same on the command line"><h3>The same on the command line</h3><code>{draft.command}</code></section>}
    </form>
  );
};
