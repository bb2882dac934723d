#pragma once

#include "emca/core/color.h"

/// The colour spaces of FLIP. XYZ are relative to the white of Rec. 709 (D65), so that white is (1, 1, 1).
namespace emca::analysis {

struct RelativeXyz {
    float x = 0, y = 0, z = 0;
};
RelativeXyz toRelativeXyz(Color linear);
Color fromRelativeXyz(const RelativeXyz& xyz);

/// L*a*b* with the chroma scaled by lightness ([LDR] section 4.1.2: the Hunt effect).
struct HuntLab {
    float l = 0, a = 0, b = 0;
};
HuntLab toHuntLab(Color linear);

/// HyAB distance ([LDR] section 4.1.3; Abasi, Tehran and Fairchild, "Distance metrics for very large color
/// differences", 2019).
float hyab(const HuntLab& a, const HuntLab& b);

/// The colour difference ΔE_c in [0, 1] of two colours of the screen ([LDR] section 4.1.4): HyAB to the power of 0.7;
/// below 0.4 of the largest difference of the screen (that of green and blue) linearly onto [0, 0.95), the rest onto
/// [0.95, 1].
float flipColorDifference(const HuntLab& a, const HuntLab& b);

/// ACES as fitted by Narkowicz, "ACES Filmic Tone Mapping Curve", 2015, without its factor 0.6 ([HDR] table 1). In [0,
/// 1].
float acesToneMap(float linear);
/// The radiance that it maps to `encoded` in (0, 1): the positive root of its quadratic ([HDR] equation 4).
double acesInverse(double encoded);

}  // namespace emca::analysis
