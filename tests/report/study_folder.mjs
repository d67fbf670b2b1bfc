// A made-up study folder that has everything a report can show, with names that try to be markup.
import {mkdirSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';

export const kHostile = `"'><script>window.hacked = 1</script><img src=x onerror="window.hacked = 2">`;
const kLong = 'x'.repeat(10000);

const kParameters = ['particle_wall', 'particle_particle'].flatMap((pair) =>
  ['restitution', 'sliding_friction', 'rolling_friction'].map((what) => `contact.${pair}.${what}`));
kParameters[4] = `contact.${kHostile}`;
kParameters[5] = `contact.particle_particle.${kLong}`;

const steps = (count, from, to) => Array.from({length: count}, (_, k) => from + (to - from) * k / (count - 1));
const kObservables = [
  {name: 'drop', unit: 'mm', measured: 9.4, moves: [0]},
  {name: 'heap', unit: 'deg', measured: 23.4, moves: [0, 1, 2, 3, 4, 5]},
  {name: `heap.${kHostile}`, unit: 'mm', measured: 120, moves: [4, 5]},
];
const simulated = (observable, values) =>
  observable.measured * observable.moves.reduce((product, k) => product * (0.6 + 0.8 * (values[kParameters[k]] ?? 0.5)), 1);
const best = Object.fromEntries(kParameters.map((name) => [name, 0.5]));

const parameter = (name, k) => ({
  name, value: 0.5, interval: [0.4, k < 3 ? 0.6 : 0.9], verdict: ['determined', 'one-sided', 'undetermined'][k % 3],
  bounds: [0.1, 0.9], advice: k > 2 ? `measure ${kHostile}` : '',
  profile: steps(9, 0.1, 0.9).map((x) => [x, 60 * (x - 0.5) ** 2]),
});
const observable = ({name, unit, measured}) => ({
  name, unit, measured, sd: 0.1 * measured, sd_assumed: true, measured_uncertainty: 0.03 * measured, simulated: measured,
  simulated_uncertainty: 0.02 * measured, simulated_sd: 0.05 * measured, difference_sigma: 0, reachable: [0.1 * measured, 3 * measured],
  verification: {simulated: measured, uncertainty: 0.1, difference_sigma: 0.2, runs: 3, failed_runs: 0},
});
const response = (of, k) => ({
  observable: of.name, parameter: kParameters[k], values: steps(41, 0.1, 0.9),
  simulated: steps(41, 0.1, 0.9).map((x) => simulated(of, {...best, [kParameters[k]]: x})),
  uncertainty: steps(41, 0.5, 1), scatter: steps(41, 1, 2),
});
const surface = (of, k, l) => ({
  observable: of.name, x_parameter: kParameters[k], y_parameter: kParameters[l], x: steps(21, 0.1, 0.9), y: steps(21, 0.1, 0.9),
  simulated: steps(21, 0.1, 0.9).map((y) => steps(21, 0.1, 0.9).map((x) => simulated(of, {...best, [kParameters[k]]: x, [kParameters[l]]: y}))),
});
const variance = {sum_of_squares: 12.5, df: 3, mean_square: 4.1, f: 9.3, p: 0.001};
const regression = (of) => ({
  observable: of.name,
  regression: {
    factors: of.moves.map((k) => ({name: kParameters[k], all_terms: variance})),
    coefficients: [{term: '1', value: 20, standard_error: 1, t: 20, p: 1e-9, natural: 20},
      {term: kHostile, value: 2, standard_error: 1, t: 2, p: 0.05, natural: null}],
    anova: {model: variance, residual: variance, lack_of_fit: null, pure_error: null, total: variance},
    r2: 0.9, r2_adjusted: 0.88, r2_predicted: null, residual_sd: 0.4, warnings: [{code: 'x', message: kHostile}],
  },
});

const kRuns = 60;
const run = (_, k) => {
  const values = Object.fromEntries(kParameters.map((name, p) => [name, 0.1 + 0.8 * ((k * (p + 1) * 0.618) % 1)]));
  const of = kObservables[k % 2];
  return {experiment: of.name, seed: k, values, readings: k === 7 ? {} : {value: simulated(of, values)}, failure: k === 7 ? kHostile : null};
};

export const writeStudyFolder = (folder, {pictures = [], finished = true} = {}) => {
  mkdirSync(join(folder, 'runs'), {recursive: true});
  const provenance = {
    program: 'repose 0', study: {file: kHostile, hash: 'abc', settings: [kHostile]}, budget: {name: 'quick', description: kHostile},
    first_seed: 1, contact_model: 'Hertz-Mindlin (no slip)', rolling_model: 'constant_torque', rolling_definition: 'mu_r F_n times x',
    clump: {source: kLong, spheres: 11, volume_error: 0.01, inertia_error: 0.001}, stiffness_factor: {drop: 1, heap: 0.01},
    shortest_timestep_s: {drop: 1e-6, heap: 1e-5},
  };
  const {program, study, budget} = provenance;
  writeFileSync(join(folder, 'study.json'), JSON.stringify({program, study, method: 'joint', budget, pictures}));
  if (!finished) {
    writeFileSync(join(folder, 'runs', 'a.json'), JSON.stringify({simulated: {experiment: kHostile, particle_wall: {restitution: 0.1}}, readings: {value: 1}, failure: ''}));
    return;
  }
  writeFileSync(join(folder, 'result.json'), JSON.stringify({
    method: 'joint', verified: true, chi2: 0.1, provenance,
    parameters: kParameters.map(parameter),
    observables: kObservables.map(observable),
    responses: kObservables.flatMap((of) => of.moves.map((k) => response(of, k))),
    surfaces: kObservables.flatMap((of) => of.moves.flatMap((k) => of.moves.filter((l) => l > k).map((l) => surface(of, k, l)))),
    regressions: kObservables.map(regression),
    correlation: kParameters.map((_, k) => kParameters.map((__, l) => (k === l ? 1 : 0.2))),
    equivalence_family: [0.3, 0.6, 0.8].map((value) => ({parameters: Object.fromEntries(kParameters.map((name) => [name, value])),
      chi2_above_best: 1, verified: true, simulated: {drop: 9}})),
    surrogates: kObservables.map(({name}) => ({observable: name, runs: 30, failed_runs: 1, leave_one_out_error: 1, leave_one_out_sigma: 1, inflation: 1})),
    rounds: [0, 1, 2].map((round) => ({round, jobs: 20 * (round + 1), estimated_core_s: 100, values: best,
      sd: Object.fromEntries(kParameters.map((name) => [name, 0.2 / (round + 1)]))})),
    warnings: [kHostile, 'the budget was small'],
    runs: Array.from({length: kRuns}, run),
  }));
};
