// The result for one picture, and the command line that does the same.
import {useState} from 'preact/hooks';
import type {Answer, Folder, Side} from './api';
import {angleText, lengthText, wayText} from './text';

export const Badge = ({status}: {status: string}) => <span class={`badge ${status}`}>{status}</span>;

const SideRow = ({name, side}: {name: string; side: Side | null}) => side && (
  <tr><th scope="row">{name}</th><td>{side.angle_deg === null ? side.status : angleText(side)}</td></tr>
);

export const Command = ({text}: {text: string}) => {
  const [is_copied, setCopied] = useState(false);
  const copy = async () => {
    await navigator.clipboard.writeText(text);
    setCopied(true);
    setTimeout(() => setCopied(false), 2000);
  };
  return (
    <div class="command">
      <h3>The same on the command line</h3>
      <code>{text}</code>
      <button type="button" onClick={copy}>{is_copied ? 'Copied' : 'Copy'}</button>
    </div>
  );
};

interface Props {
  answer: Answer;
  definitions: Folder['definitions'];
  has_changes: boolean;
  needs_length: boolean;  // for a line that was drawn
  is_saved: boolean;
  is_told_here: boolean;  // hints are given here, not on the command line as with a lens
  can_undo: boolean;
  undo: () => void;
  save: () => void;
  forget: () => void;
  propose: () => void;
}

export const Result = ({answer, definitions, has_changes, needs_length, is_saved, is_told_here, can_undo, undo, save, forget, propose}: Props) => {
  const {measured, proposed, command} = answer;
  return (
    <section class="result" aria-label="Result">
      <div role="status" aria-live="polite">
        <p class="angle">{angleText(measured)} <Badge status={measured.status} /></p>
        {measured.reason && <p class="reason">{measured.reason}</p>}
      </div>
      {proposed && is_told_here && !has_changes &&
        <p><button type="button" class="main" onClick={propose}>Try what is proposed</button></p>}
      <table>
        <tbody>
          <SideRow name="left" side={measured.left} />
          <SideRow name="right" side={measured.right} />
          {measured.height_mm !== null &&
            <tr><th scope="row">height</th><td>{lengthText(measured.height_mm, measured.height_mm_uncertainty)}</td></tr>}
          {measured.base_mm !== null &&
            <tr><th scope="row">base</th><td>{lengthText(measured.base_mm, measured.base_mm_uncertainty)}</td></tr>}
          {measured.window && <tr><th scope="row">by</th><td>{wayText(measured, definitions)}</td></tr>}
        </tbody>
      </table>
      {measured.warnings.map(({code, message}) => <p class="warning" key={code}>{message}</p>)}
      {is_told_here && (
        <div class="actions">
          <button type="button" class="main" disabled={!has_changes || needs_length} onClick={save}>Save</button>
          <button type="button" disabled={!can_undo} onClick={undo}>Undo</button>
          <button type="button" disabled={!is_saved && !has_changes} onClick={forget}>Start again</button>
          <p class="hint">{needs_length ? 'Say how many mm the line is long.' : has_changes ? 'Not saved yet.' : is_saved ? 'Corrections are saved beside the picture.' : 'Nothing was corrected.'}</p>
        </div>
      )}
      <p><a href={`/api/overlay?file=${encodeURIComponent(measured.file.split('/').pop() ?? '')}`} download={`${measured.file.split('/').pop()}.overlay.jpg`}>Picture with its overlay</a></p>
      <Command text={command} />
    </section>
  );
};
