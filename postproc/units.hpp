// Units of clothing pressure. Inside snug every pressure is in Pa; these appear only where people read and write
// numbers.
#pragma once

namespace snug::postproc {

inline constexpr double pascal_per_gf_cm2 = 98.0665;      ///< exact: 1e-3 kg x 9.80665 m/s2 / 1e-4 m2
inline constexpr double pascal_per_mmHg = 133.322387415;  ///< conventional millimetre of mercury, NIST SP 811

inline constexpr double to_gf_cm2(double pascal) { return pascal / pascal_per_gf_cm2; }
inline constexpr double to_mmHg(double pascal) { return pascal / pascal_per_mmHg; }
inline constexpr double from_gf_cm2(double value) { return value * pascal_per_gf_cm2; }
inline constexpr double from_mmHg(double value) { return value * pascal_per_mmHg; }

}  // namespace snug::postproc
