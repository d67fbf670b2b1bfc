// The folder's files, each with its picture, angle and status.
import type {Answer, FileEntry} from './api';
import {api} from './api';
import {Badge} from './result';
import {angleText} from './text';

interface Props {
  files: FileEntry[];
  answers: Map<string, Answer>;
  errors: Map<string, string>;
  chosen: string | null;
  choose: (file: string) => void;
}

export const Files = ({files, answers, errors, chosen, choose}: Props) => (
  <nav class="files" aria-label="Pictures">
    <ul>
      {files.map((entry) => {
        const answer = answers.get(entry.file);
        const error = errors.get(entry.file);
        return (
          <li key={entry.file}>
            <button type="button" aria-current={entry.file === chosen} onClick={() => choose(entry.file)}>
              {answer ? <img src={api.picture(entry, 160, answer.told?.rotate_deg ?? 0)} alt="" loading="lazy" /> : <span class="waiting" />}
              <span class="name">{entry.file}</span>
              <span class="value">{error ?? (answer ? angleText(answer.measured) : 'measuring …')}</span>
              {answer && <Badge status={answer.measured.status} />}
              {entry.has_hints && <span class="corrected">corrected</span>}
            </button>
          </li>
        );
      })}
    </ul>
  </nav>
);
