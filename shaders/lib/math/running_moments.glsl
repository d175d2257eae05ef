// Mean and variance of samples as they come, without the cancellation of sum(x^2) - sum(x)^2 / n.
// Based on: Welford, "Note on a Method for Calculating Corrected Sums of Squares and Products", Technometrics 4(3), 1962.
#include "shared/lab.h"

LabMoments noMoments() {
    return LabMoments(0.0, 0.0, 0u);
}

void addSample(inout LabMoments moments, float x) {
    moments.count += 1u;
    const float fromOldMean = x - moments.mean;
    moments.mean += fromOldMean / float(moments.count);
    moments.squares += fromOldMean * (x - moments.mean);
}
