#include "emca/core/surface_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

namespace emca {
namespace {

double area(const std::vector<Vec3f>& positions, const Triangle& t) {
    const Vec3f a = positions[t[0]], b = positions[t[1]], c = positions[t[2]];
    return 0.5 * double(length(cross(b - a, c - a)));
}

/// A square of two triangles that share the edge (0, 2).
Mesh square() {
    Mesh mesh;
    mesh.name = "square";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

/// Bits in the order of reading.
SurfaceSubdivision subdivision(const std::string& zerosAndOnes) {
    SurfaceSubdivision out;
    out.bits.resize((zerosAndOnes.size() + 7) / 8);
    for (std::size_t i = 0; i < zerosAndOnes.size(); ++i)
        if (zerosAndOnes[i] == '1') out.bits[i / 8] = static_cast<std::uint8_t>(out.bits[i / 8] | 1u << (i % 8));
    return out;
}

/// A random tree for each face.
SurfaceSubdivision randomSubdivision(std::mt19937& random, std::size_t faces, int maximum) {
    std::string bits;
    const auto tree = [&](const auto& self, int level) -> void {
        const bool divide = level < maximum && (level < 2 || random() % 3 == 0);
        bits += divide ? '1' : '0';
        for (int child = 0; divide && child < 4; ++child) self(self, level + 1);
    };
    for (std::size_t face = 0; face < faces; ++face) tree(tree, 0);
    return subdivision(bits);
}

TEST(Refine, NoBitsIsTheMeshItself) {
    const Mesh mesh = square();
    const auto refined = refine(mesh, {});
    ASSERT_TRUE(refined.ok());
    EXPECT_EQ(refined->triangles, mesh.triangles);
    EXPECT_EQ(refined->positions, mesh.positions);
    EXPECT_EQ(refined->baseFace, (std::vector<std::uint32_t>{0, 1}));
}

TEST(Refine, NeighboursShareMidpointsAndKeepOrientation) {
    const auto refined = refine(square(), subdivision("1000010000"));
    ASSERT_TRUE(refined.ok());
    ASSERT_EQ(refined->triangles.size(), 8u);
    EXPECT_EQ(refined->positions.size(), 9u);  // the diagonal's midpoint once
    for (const Triangle& t : refined->triangles) {
        const Vec3f a = refined->positions[t[0]];
        EXPECT_EQ(cross(refined->positions[t[1]] - a, refined->positions[t[2]] - a), (Vec3f{0, 0, 0.25f}));
    }
    EXPECT_EQ(refined->triangles[3], (Triangle{5, 6, 4}));  // the one in the middle comes last
}

TEST(Refine, AreaIsKeptAndCrackFree) {
    std::mt19937 random(7);
    for (int round = 0; round < 20; ++round) {
        const SurfaceSubdivision bits = randomSubdivision(random, 2, 7);
        const auto refined = refine(square(), bits);
        ASSERT_TRUE(refined.ok()) << refined.error().message;
        double sum = 0;
        for (const Triangle& t : refined->triangles) sum += area(refined->positions, t);
        EXPECT_NEAR(sum, 1.0, 1e-6);
        EXPECT_EQ(refined->triangles.size(), *refinedFaceCount(2, bits));
        std::map<std::array<float, 2>, int> seen;
        for (const Vec3f p : refined->positions) EXPECT_EQ((++seen[{p.x, p.y}]), 1);
    }
}

TEST(Refine, MidpointsLieBetweenTheirVertices) {
    std::mt19937 random(9);
    const auto refined = refine(square(), randomSubdivision(random, 2, 6));
    ASSERT_TRUE(refined.ok());
    ASSERT_EQ(refined->midpointOf.size(), refined->positions.size() - 4);
    for (std::size_t i = 0; i < refined->midpointOf.size(); ++i) {
        const auto [a, b] = refined->midpointOf[i];
        EXPECT_EQ(refined->positions[4 + i], (refined->positions[a] + refined->positions[b]) * 0.5f);
    }
}

TEST(Refine, WhatIsCutOrLeftOverIsRefusedAndTheWholeStillDecodes) {
    std::mt19937 random(11);
    const SurfaceSubdivision whole = randomSubdivision(random, 2, 6);
    ASSERT_GT(whole.bits.size(), 2u);
    ASSERT_TRUE(refine(square(), whole).ok());
    for (std::size_t size = 1; size < whole.bits.size(); ++size) {
        SurfaceSubdivision cut = whole;
        cut.bits.resize(size);
        const auto refined = refine(square(), cut);
        ASSERT_FALSE(refined.ok()) << size;
        EXPECT_EQ(refined.error().code, ErrorCode::protocolViolation);
        EXPECT_FALSE(SurfaceLocator::make(2, cut).ok());
    }
    SurfaceSubdivision more = whole;
    more.bits.push_back(0);
    EXPECT_FALSE(refine(square(), more).ok());
    EXPECT_FALSE(refine(square(), SurfaceSubdivision{{0b100}}).ok());  // a bit behind the two that are read
    EXPECT_TRUE(refine(square(), SurfaceSubdivision{{0}}).ok());
}

TEST(Refine, GarbageIsRefusedOrConsistent) {
    std::mt19937 random(13);
    int good = 0;
    for (int round = 0; round < 3000; ++round) {
        SurfaceSubdivision garbage;
        garbage.bits.resize(1 + random() % 4);
        for (auto& byte : garbage.bits) byte = static_cast<std::uint8_t>(random() & random());
        const auto count = refinedFaceCount(2, garbage);
        const auto refined = refine(square(), garbage);
        ASSERT_EQ(count.ok(), refined.ok());
        if (!refined.ok()) continue;
        ++good;
        EXPECT_EQ(refined->triangles.size(), *count);
    }
    EXPECT_GT(good, 10);
}

TEST(Refine, NothingDividesBelowTheLastLevel) {
    // Always the first child, down to the last level, which has no bits; then the zeros of all siblings above it.
    std::string bits(kMaxSurfaceLevel, '1');
    bits += std::string(3 * (kMaxSurfaceLevel - 1), '0');
    const auto count = refinedFaceCount(1, subdivision(bits));
    ASSERT_TRUE(count.ok()) << count.error().message;
    EXPECT_EQ(*count, 3 * kMaxSurfaceLevel + 1);
    EXPECT_FALSE(refinedFaceCount(1, subdivision(bits + "10000000")).ok());
    const auto locator = SurfaceLocator::make(1, subdivision(bits));
    ASSERT_TRUE(locator.ok());
    EXPECT_EQ(locator->refinedFace(0, 0.f, 0.f), 0u);
    EXPECT_EQ(locator->refinedFace(0, 1.f, 0.f), 3 * kMaxSurfaceLevel + 1 - 3);
    EXPECT_EQ(locator->refinedFace(0, 0.f, 1.f), 3 * kMaxSurfaceLevel + 1 - 2);
}

TEST(Refine, AMeshWithBadIndicesIsRefused) {
    Mesh mesh = square();
    mesh.triangles.push_back({0, 1, 9});
    EXPECT_EQ(refine(mesh, {}).error().code, ErrorCode::invalidArgument);
}

TEST(SurfaceLocator, FindsTheFaceThatContainsThePoint) {
    std::mt19937 random(17);
    std::uniform_real_distribution<float> uniform;
    const Mesh mesh = square();
    const SurfaceSubdivision bits = randomSubdivision(random, 2, 8);
    const auto refined = refine(mesh, bits);
    const auto locator = SurfaceLocator::make(2, bits);
    ASSERT_TRUE(refined.ok() && locator.ok());
    EXPECT_EQ(locator->refinedFaceCount(), refined->triangles.size());
    Mesh fine;
    fine.positions = refined->positions;
    fine.triangles = refined->triangles;
    for (int i = 0; i < 20000; ++i) {
        const std::uint32_t face = random() % 2;
        float u = uniform(random), v = uniform(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const auto found = locator->refinedFace(face, u, v);
        ASSERT_TRUE(found.has_value());
        EXPECT_EQ(refined->baseFace[*found], face);
        const Triangle t = mesh.triangles[face];
        const Vec3f p = mesh.positions[t[0]] * (1 - u - v) + mesh.positions[t[1]] * u + mesh.positions[t[2]] * v;
        const auto inside = barycentrics(fine, *found, p);
        ASSERT_TRUE(inside.has_value());
        EXPECT_GE(inside->x, -1e-3f);
        EXPECT_GE(inside->y, -1e-3f);
        EXPECT_LE(inside->x + inside->y, 1 + 1e-3f);
    }
    EXPECT_FALSE(locator->refinedFace(2, 0.1f, 0.1f).has_value());
    EXPECT_FALSE(locator->refinedFace(0, std::numeric_limits<float>::quiet_NaN(), 0.1f).has_value());
    EXPECT_TRUE(locator->refinedFace(0, -5.f, 9.f).has_value());
    EXPECT_TRUE(locator->refinedFace(0, 1e30f, 1e30f).has_value());
}

TEST(Barycentrics, OfTrianglesWithoutAreaThereAreNone) {
    Mesh mesh = square();
    mesh.triangles = {{0, 0, 1}, {0, 1, 2}, {0, 1, 7}};
    EXPECT_FALSE(barycentrics(mesh, 0, {0, 0, 0}).has_value());
    EXPECT_FALSE(barycentrics(mesh, 2, {0, 0, 0}).has_value());
    EXPECT_FALSE(barycentrics(mesh, 3, {0, 0, 0}).has_value());
    EXPECT_FALSE(barycentrics(mesh, 1, {std::numeric_limits<float>::infinity(), 0, 0}).has_value());
    const auto b = barycentrics(mesh, 1, {0.75f, 0.25f, 3.f});
    ASSERT_TRUE(b.has_value());
    EXPECT_FLOAT_EQ(b->x, 0.5f);
    EXPECT_FLOAT_EQ(b->y, 0.25f);
}

/// A field on two squares; the second was never sampled.
SurfaceField twoSquares() {
    SurfaceField field;
    field.meshes = {{subdivision("100000"), 0, 5}, {{}, 5, 0}};
    field.points = std::vector<float>(5, 1.f);
    field.layers.push_back({{"path depth", LayerKind::mean, "", ""}, std::vector<float>{1, 2, 3, 4, 5}, 5, 15});
    field.layers.push_back({{"radiance", LayerKind::meanColor, "", ""}, std::vector<float>(15, 2.f), 5, 10});
    return field;
}

TEST(SurfaceField, EveryRuleIsChecked) {
    const std::vector<Mesh> meshes = {square(), square()};
    const SurfaceField good = twoSquares();
    ASSERT_TRUE(validate(good, meshes).ok()) << validate(good, meshes).error().message;
    const auto refused = [&](auto spoil) {
        SurfaceField bad = twoSquares();
        spoil(bad);
        const auto result = validate(bad, meshes);
        return !result.ok() && result.error().code == ErrorCode::protocolViolation;
    };
    EXPECT_TRUE(refused([](SurfaceField& f) { f.meshes.pop_back(); }));
    EXPECT_TRUE(refused([](SurfaceField& f) { f.meshes[1].firstFace = 4; }));
    EXPECT_TRUE(refused([](SurfaceField& f) { f.meshes[0].faceCount = 4; f.meshes[1].firstFace = 4; }));
    EXPECT_TRUE(refused([](SurfaceField& f) { f.meshes[1].subdivision = subdivision("00"); }));
    EXPECT_TRUE(refused([](SurfaceField& f) { f.meshes[0].subdivision.bits.push_back(1); }));
    EXPECT_TRUE(refused([](SurfaceField& f) { f.points = std::vector<float>(4); }));
    EXPECT_TRUE(refused([](SurfaceField& f) { f.layers[0].values = std::vector<float>(4); }));
    EXPECT_TRUE(refused([](SurfaceField& f) { f.layers[1].description.kind = LayerKind::mean; }));
    EXPECT_TRUE(refused([](SurfaceField& f) { f.layers[1].description.kind = LayerKind(9); }));
    EXPECT_TRUE(refused([](SurfaceField& f) { f.layers[1].description.name = "path depth"; }));
    EXPECT_TRUE(refused([](SurfaceField& f) { f.layers[1].description.name.clear(); }));
}

TEST(SurfaceField, ValueWhereThereIsNone) {
    const SurfaceField field = twoSquares();
    EXPECT_EQ(field.value(field.layers[0], 0, 3), 4.f);
    EXPECT_EQ(field.value(field.layers[1], 0, 4, 2), 2.f);
    EXPECT_TRUE(std::isnan(field.value(field.layers[0], 1, 0)));
    EXPECT_TRUE(std::isnan(field.value(field.layers[0], 7, 0)));
    EXPECT_EQ(field.find("radiance"), &field.layers[1]);
    EXPECT_EQ(field.find("nothing"), nullptr);
}

}  // namespace
}  // namespace emca
