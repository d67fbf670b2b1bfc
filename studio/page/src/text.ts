// Results in words.
import type {Comparison, Folder, Mean, Measured} from './api';

export const angleText = (measured: Pick<Measured, 'angle_deg' | 'uncertainty_deg'>) => {
  if (measured.angle_deg === null) return 'no angle';
  const angle = measured.angle_deg.toFixed(2);
  return measured.uncertainty_deg === null ? `${angle}°` : `${angle} ± ${measured.uncertainty_deg.toFixed(2)}°`;
};

// How the angle is defined: its definition in words, or the requested window instead.
export const wayText = ({definition, window}: Measured, definitions: Folder['definitions']) => {
  const known = definitions.find(({name}) => name === definition);
  if (known) return `${known.name}: ${known.description}`;
  return window && `${Math.round(100 * window[0])}–${Math.round(100 * window[1])} % of the height`;
};

export const differenceText = ({angle_difference_deg, angle_difference_interval, margin_deg}: Comparison) => {
  if (angle_difference_deg === null || !angle_difference_interval) return 'no difference: that needs two heaps with an angle in one of the sets';
  const [low, high] = angle_difference_interval;
  const signed = (angle: number) => angle.toFixed(2).replace('-', '−');
  return `first − second: ${signed(angle_difference_deg)}°, 95 % interval ${signed(low)} … ${signed(high)}° (Welch); below ${margin_deg}° negligible`;
};

export const lengthText = (value: number | null, half: number | null) =>
  value === null ? '–' : `${value.toFixed(1)}${half === null ? '' : ` ± ${half.toFixed(1)}`} mm`;

export const meanText = (mean: Mean) => {
  if (mean.mean_deg === null) return 'no mean: no picture has an angle';
  const middle = `mean ${mean.mean_deg.toFixed(2)}°`;
  if (mean.sd_deg === null || mean.interval_deg === null) return `${middle}, n = ${mean.n}: no scatter of one heap`;
  const [low, high] = mean.interval_deg;
  return `${middle}, sd ${mean.sd_deg.toFixed(2)}°, n = ${mean.n}, 95 % interval of the mean ${low.toFixed(2)} … ${high.toFixed(2)}° (Student)`;
};
