// The folder's files, each with its picture, angle and status.
import type {Answer, FileEntry} from './api';
import {api} from './api';
import type {Filmed} from './film';
import {filmedByName} from './film';
import {Badge} from './result';
import {angleText} from './text';

interface Props {
  files: FileEntry[];
  answers: Map<string, Answer>;
  errors: Map<string, string>;
  filmed: Map<string, Filmed>;
  chosen: string | null;
  choose: (file: string) => void;
}

export const Files = ({files, answers, errors, filmed, chosen, choose}: Props) => (
  <nav class="files" aria-label="Pictures">
    <ul>
      {files.map((entry) => {
        const answer = answers.get(entry.file);
        const error = errors.get(entry.file);
        // The missing heap in a film of a drop, a roll or a tilt means nothing.
        const shows = entry.kind === 'film' ? filmed.get(entry.file) ?? filmedByName(entry.file) : 'heap';
        return (
          <li key={entry.file}>
            <button type="button" aria-current={entry.file === chosen} onClick={() => choose(entry.file)}>
              {answer ? <img src={api.picture(entry, 160, answer.told?.rotate_deg ?? 0)} alt="" loading="lazy" /> : <span class="waiting" />}
              <span class="name">{entry.file}</span>
              <span class="value">{shows !== 'heap' ? `film of a ${shows}` : error ?? (answer ? angleText(answer.measured) : 'measuring …')}</span>
              {answer && shows === 'heap' && <Badge status={answer.measured.status} />}
              {entry.has_hints && <span class="corrected">corrected</span>}
            </button>
          </li>
        );
      })}
    </ul>
  </nav>
);
