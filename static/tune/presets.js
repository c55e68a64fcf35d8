// @ts-check
// Lasers and the range precision of their data sheets, from which ε and its growth κ are taken: √(ε² + (κρ)²) is about
// the stated error at each range ρ, but never less than 20 mm.

/** @type {readonly {laser: string, range: string, params: {epsilon: number, epsilon_growth: number}}[]} */
export const PRESETS = Object.freeze([
  {
    laser: "Hokuyo UTM-30LX",
    range: "±30 mm to 10 m, ±50 mm to 30 m",
    params: { epsilon: 0.03, epsilon_growth: 0.002 },
  },
  { laser: "Hokuyo URG-04LX", range: "±10 mm to 1 m, ±1 % to 4 m", params: { epsilon: 0.02, epsilon_growth: 0.01 } },
  { laser: "SICK LMS1xx", range: "±30 mm, statistical 12 mm (1σ)", params: { epsilon: 0.04, epsilon_growth: 0 } },
  {
    laser: "SICK LMS200 / LMS291",
    range: "±15 mm, statistical 5 mm (1σ)",
    params: { epsilon: 0.02, epsilon_growth: 0 },
  },
  { laser: "RPLIDAR A1", range: "about 1 % of the range", params: { epsilon: 0.02, epsilon_growth: 0.01 } },
  { laser: "RPLIDAR A2", range: "about 1 % of the range", params: { epsilon: 0.02, epsilon_growth: 0.01 } },
  { laser: "LDROBOT LD06", range: "±45 mm to 12 m", params: { epsilon: 0.045, epsilon_growth: 0 } },
  {
    laser: "LDS-01 (TurtleBot3)",
    range: "±10 mm to 0.5 m, ±3.5 % to 3.5 m",
    params: { epsilon: 0.02, epsilon_growth: 0.035 },
  },
]);
