// A study folder whose names try to be markup; its result and runs are written by made_up_result.cpp.
import {mkdirSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';

const kHostile = `"'><script>window.hacked = 1</script><img src=x onerror="window.hacked = 2">`;

export const writeStudyFolder = (folder, {pictures = []} = {}) => {
  mkdirSync(join(folder, 'runs'), {recursive: true});
  writeFileSync(join(folder, 'study.json'), JSON.stringify({
    program: 'repose 0', study: {file: kHostile, hash: 'abc', settings: [kHostile]}, method: 'joint',
    budget: {name: 'quick', description: kHostile}, pictures}));
};
