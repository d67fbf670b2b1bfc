// Corrections of the chosen picture: measured as they are made, undone, saved.
import {useRef, useState} from 'preact/hooks';
import type {Answer, FileEntry, Told} from './api';
import {api} from './api';

// A picture that is being corrected. `told` is ahead of `answer` while it is measured.
interface Edit {
  file: string;
  version: string;  // that it began with: another that is saved meanwhile is not written over
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
    waiting.current = {file: entry!.file, told};
    void measure();
  };
  // What a drag began with: one step to undo, however many it was measured in.
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
      await look();  // what is saved beside it is there, or gone
    } catch (error) {
      await look();  // who wrote meanwhile
      setTrouble((error as Error).message);
    }
  };
  const save = () => void write((version) => api.save(entry!.file, current!.told, version));
  const forget = () => void write((version) => api.forget(entry!.file, version));
  const drop = () => { waiting.current = null; setEdit(null); setTrouble(''); };
  const keep = () => { setEdit((before) => before && {...before, version: answer!.version}); setTrouble(''); };
  return {current: current && {...current, is_behind: !!answer && current.version !== answer.version}, tell, undo, save, forget, drop, keep};
};
