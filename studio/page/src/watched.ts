// State that is polled while the page is visible.
import {useCallback, useEffect, useState} from 'preact/hooks';
import type {Calibration} from './study_api';
import {studies} from './study_api';

const kLook_ms = 1000;

/** Calls `look` now and then at these intervals, but not while the window is hidden. */
export const useLooking = (look: () => Promise<void>, every_ms: number) => {
  useEffect(() => {
    void look();
    const timer = setInterval(() => { if (!document.hidden) void look(); }, every_ms);
    return () => clearInterval(timer);
  }, [look, every_ms]);
};

/** State of a study's calibration, the last error, and how to run the user's requests. */
export const useCalibration = (study: string, refresh: () => Promise<void>) => {
  const [state, setState] = useState<Calibration | null>(null);
  const [trouble, setTrouble] = useState('');
  const look = useCallback(async () => {
    try {
      setState(await studies.calibration(study));
    } catch (error) {
      setTrouble((error as Error).message);
    }
  }, [study]);
  useLooking(look, kLook_ms);
  const act = async (work: Promise<unknown>) => {
    try {
      await work;
      setTrouble('');
    } catch (error) {
      setTrouble((error as Error).message);
    }
    await look();
    await refresh();
  };
  return {state, trouble, look, act};
};
