#include "shapes/tessellation_face.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace emca::render {

namespace {

constexpr double kPi = 3.14159265358979323846;

// As in makeSphere() and makeDisk() of triangle_mesh.cpp; a test compares both.
constexpr int kAround = 46, kDown = 23, kSegments = 64;

struct SineCosine { double sine, cosine; };

template <int Count>
std::array<SineCosine, Count + 1> makeTable(double whole) {
    std::array<SineCosine, Count + 1> table{};
    for (int i = 0; i <= Count; ++i) {
        const double angle = whole * i / Count;
        table[static_cast<std::size_t>(i)] = {std::sin(angle), std::cos(angle)};
    }
    return table;
}

const auto kRows = makeTable<kDown>(kPi);
const auto kColumns = makeTable<kAround>(2 * kPi);

Vec3d corner(int row, int column) {
    const SineCosine theta = kRows[static_cast<std::size_t>(row)], phi = kColumns[static_cast<std::size_t>(column)];
    return {theta.sine * phi.cosine, theta.sine * phi.sine, theta.cosine};
}

}  // namespace

std::int32_t sphereFace(Vec3f local) {
    const Vec3d d{double(local.x), double(local.y), double(local.z)};
    double azimuth = std::atan2(d.y, d.x);
    if (azimuth < 0) azimuth += 2 * kPi;
    const int column = std::clamp(static_cast<int>(azimuth / (2 * kPi) * kAround), 0, kAround - 1);
    // Seen from the centre, the edge between two rows is not a parallel but the great circle through two corners,
    // which bulges towards the pole: cot(theta) / cos(half a column) at the column's middle.
    constexpr double kHalfColumn = kPi / kAround;
    const double off = azimuth - (2 * column + 1) * kHalfColumn;
    static const double cosHalf = std::cos(kHalfColumn);
    const double polar = std::atan2(std::hypot(d.x, d.y) * std::cos(off), d.z * cosHalf);
    const int row = std::clamp(static_cast<int>(polar / kPi * kDown), 0, kDown - 1);

    if (row == 0) return column;
    if (row == kDown - 1) return kAround + 2 * kAround * (kDown - 2) + column;
    const Vec3d diagonal = cross(corner(row, column), corner(row + 1, column + 1));
    const int lower = dot(diagonal, d) * dot(diagonal, corner(row + 1, column)) >= 0 ? 0 : 1;
    return kAround + 2 * kAround * (row - 1) + 2 * column + lower;
}

std::int32_t diskFace(float turn) {
    return std::clamp(static_cast<std::int32_t>(turn * kSegments), 0, kSegments - 1);
}

}  // namespace emca::render
