#include "bsdfs/media_ior.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace emca::render {

namespace {

constexpr std::array<std::pair<std::string_view, double>, 23> kMedia = {{
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.5750},      {"diamond", 2.419},
}};

struct NamedMetal {
    std::string_view name;
    MetalIor ior;
};

// Measured n and k over the visible range (E. Palik, "Handbook of Optical Constants of Solids", 1985, and the sources
// collected there), each integrated against the CIE 1931 matching functions under equal energy and taken to linear
// Rec. 709, as Mitsuba 0.6 does in its build without wavelengths, whose pictures they reproduce. (Equal energy is not
// the white of Rec. 709, so they lean to red by a little.) Rounded to four digits.
constexpr std::array<NamedMetal, 21> kMetals = {{
    {"a-C", {{2.9441f, 2.2272f, 1.9682f}, {0.8874f, 0.7993f, 0.8153f}}},
    {"Ag", {{0.1553f, 0.1167f, 0.1384f}, {4.8283f, 3.1222f, 2.1470f}}},
    {"Al", {{1.6575f, 0.8804f, 0.5212f}, {9.2239f, 6.2695f, 4.8370f}}},
    {"Au", {{0.1431f, 0.3750f, 1.4425f}, {3.9832f, 2.3857f, 1.6032f}}},
    {"Be", {{4.1851f, 3.1851f, 2.7841f}, {3.8354f, 3.0101f, 2.8690f}}},
    {"Cr", {{4.3697f, 2.9167f, 1.6547f}, {5.2064f, 4.2314f, 3.7549f}}},
    {"Cu", {{0.2004f, 0.9240f, 1.1022f}, {3.9129f, 2.4528f, 2.1422f}}},
    {"Hg", {{2.3989f, 1.4400f, 0.9096f}, {6.3276f, 4.3719f, 3.4218f}}},
    {"Ir", {{3.0864f, 2.0822f, 1.6179f}, {5.5922f, 4.0672f, 3.2673f}}},
    {"K", {{0.0640f, 0.0464f, 0.0382f}, {2.1042f, 1.3489f, 0.9132f}}},
    {"Li", {{0.2658f, 0.1956f, 0.2209f}, {3.5402f, 2.3111f, 1.6686f}}},
    {"Mo", {{4.4837f, 3.5255f, 2.7761f}, {4.1111f, 3.4209f, 3.1506f}}},
    {"Na", {{0.0603f, 0.0561f, 0.0620f}, {3.1793f, 2.1125f, 1.5791f}}},
    {"Nb", {{3.4201f, 2.7902f, 2.3956f}, {3.4414f, 2.7376f, 2.5799f}}},
    {"Ni", {{2.3673f, 1.6634f, 1.4671f}, {4.4988f, 3.0502f, 2.3454f}}},
    {"Rh", {{2.5858f, 1.8602f, 1.5544f}, {6.7823f, 4.7030f, 3.9761f}}},
    {"Ta", {{2.0626f, 2.3931f, 2.6280f}, {2.4080f, 1.7414f, 1.9470f}}},
    {"TiN", {{1.6485f, 1.1504f, 1.3798f}, {3.3685f, 1.9435f, 1.1020f}}},
    {"V", {{4.2775f, 3.5132f, 2.7611f}, {3.4912f, 2.8894f, 3.1117f}}},
    {"VN", {{2.8656f, 2.1192f, 1.9401f}, {3.0323f, 2.0561f, 1.6163f}}},
    {"W", {{4.3707f, 3.3003f, 2.9983f}, {3.5007f, 2.6049f, 2.2732f}}},
}};

bool equalIgnoringCase(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

std::optional<double> mediumIor(std::string_view name) {
    for (const auto& [medium, ior] : kMedia) {
        if (equalIgnoringCase(medium, name)) return ior;
    }
    return std::nullopt;
}

std::optional<MetalIor> metalIor(std::string_view name) {
    for (const NamedMetal& metal : kMetals) {
        if (metal.name == name) return metal.ior;
    }
    return std::nullopt;
}

}  // namespace emca::render
