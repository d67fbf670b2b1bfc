// The folder's files, measured as they arrive, and again when their version changes.
import {useCallback, useEffect, useRef, useState} from 'preact/hooks';
import type {Answer, Folder, Marks} from './api';
import {api} from './api';
import {useLooking} from './watched';

const kLookAgain_ms = 3000;
// A browser opens six connections to a server; pictures and the user's actions need some of them.
const kAtOnce = 3;

// The outlines of a thousand pictures would fill the browser's memory.
const withoutMarks = (answer: Answer): Answer => ({...answer, marks: null});

// The file to measure next: the one in view before all others.
const nextOf = (folder: Folder | null, asked: Map<string, string>, chosen: string | null) => {
  const isNew = ({file, version}: Folder['files'][number]) => asked.get(file) !== version;
  return folder?.files.find((entry) => entry.file === chosen && isNew(entry)) ?? folder?.files.find(isNew);
};

export const useFolder = (chosen: string | null) => {
  const [folder, setFolder] = useState<Folder | null>(null);
  const [answers, setAnswers] = useState(new Map<string, Answer>());
  const [errors, setErrors] = useState(new Map<string, string>());
  const [marks, setMarks] = useState<{file: string; version: string; marks: Marks | null} | null>(null);
  const [trouble, setTrouble] = useState('');
  const [lost, setLost] = useState('');  // why the studio does not answer
  const asked = useRef(new Map<string, string>());  // versions
  const latest = useRef<Folder | null>(null);
  const wanted = useRef(chosen);
  const working = useRef(0);
  wanted.current = chosen;

  const take = useCallback((file: string, answer: Answer) => {
    asked.current.set(file, answer.version);
    setAnswers((before) => new Map(before).set(file, withoutMarks(answer)));
    setErrors((before) => { if (!before.has(file)) return before; const after = new Map(before); after.delete(file); return after; });
    if (file === (wanted.current ?? latest.current?.files[0]?.file)) setMarks({file, version: answer.version, marks: answer.marks});
  }, []);
  const work = useCallback(async () => {
    if (working.current >= kAtOnce) return;
    ++working.current;
    for (let next; (next = nextOf(latest.current, asked.current, wanted.current)); ) {
      const {file, version} = next;
      asked.current.set(file, version);
      try {
        take(file, await api.measured(file));
      } catch (error) {
        setErrors((before) => new Map(before).set(file, (error as Error).message));
      }
    }
    --working.current;
  }, [take]);
  const look = useCallback(async () => {
    try {
      const now = await api.folder();
      latest.current = now;
      setFolder(now);
      setLost('');
      for (let k = 0; k < kAtOnce; ++k) void work();
    } catch (error) {
      setLost((error as Error).message);
    }
  }, [work]);
  useLooking(look, kLookAgain_ms);

  // Fetches the lines of the file in view again; the studio has kept them.
  const file = chosen ?? folder?.files[0]?.file ?? null;
  const version = file ? answers.get(file)?.version : undefined;
  useEffect(() => {
    if (!file || !version || (marks?.file === file && marks.version === version)) return;
    api.measured(file).then((answer) => take(file, answer), (error: Error) => setTrouble(error.message));
  }, [file, version, marks]);
  return {folder, answers, errors, marks, trouble: lost || trouble, setTrouble, look, take};
};
