// Student's t distribution.
#pragma once

namespace lavalight {

// The probability of a value beyond -t or t, for t of at least 0 (infinity included) and any positive number
// of degrees of freedom, to a relative error of 1e-9. With many degrees it is that of the normal
// distribution.
[[nodiscard]] double studentTwoSidedTail(double t, double degreesOfFreedom);

} // namespace lavalight
