// Corrections of the selected picture: measured as they are made, undone, saved.
import {useRef, useState} from 'preact/hooks';
import type {Answer, FileEntry, Told} from './api';
import {api} from './api';

// A picture being corrected. `told` is ahead of `answer` during a measurement.
interface Edit {
  file: string;
  version: string;  // at the start; a newer one saved meanwhile is not overwritten
  told: Told;
  answer: Answer;
  past: Told[];  // for undo
}

export const useEdit = (entry: FileEntry | null, answer: Answer | undefined, setTrouble: (text: string) => void,
    look: () => Promise<void>, take: (file: string, answer: Answer) => void) => {
  const [edit, setEdit] = useState<Edit | null>(null);
  const waiting = useRef<{file: string; told: Told} | null>(null);
  const is_measuring = useRef(false);
  const current = edit && edit.file === entry?.file ? edit : null;

  // One at a time; the newest of the requests that arrive meanwhile is next.
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
    waiting.current = {file: entry!.file, told};
    void measure();
  };
  // State at the start of a drag: one undo step, however many measurements the drag triggers.
  const began = useRef<Told | null>(null);
  const tell = (told: Told, ends: boolean) => {
    if (!entry || !answer?.told) return;
    const before = current ?? {file: entry.file, version: answer.version, told: answer.told, answer, past: []};
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
  const write = async (work: (version: string) => Promise<Answer>) => {
    try {
      const found = await work(current?.version ?? answer!.version);
      waiting.current = null;
      take(entry!.file, found);
      setEdit(null);
      setTrouble('');
      await look();  // the file saved beside it has appeared or gone
    } catch (error) {
      await look();  // somebody else may have written meanwhile
      setTrouble((error as Error).message);
    }
  };
  const save = () => void write((version) => api.save(entry!.file, current!.told, version));
  const forget = () => void write((version) => api.forget(entry!.file, version));
  const drop = () => { waiting.current = null; setEdit(null); setTrouble(''); };
  const keep = () => { setEdit((before) => before && {...before, version: answer!.version}); setTrouble(''); };
  return {current: current && {...current, is_behind: !!answer && current.version !== answer.version}, tell, undo, save, forget, drop, keep};
};
