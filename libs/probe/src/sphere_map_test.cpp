#include "emca/probe/sphere_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace emca::probe {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3f randomDirection(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return normalize(Vec3f{normal(random), normal(random), normal(random)});
}

SphereMap anyMap(std::uint32_t width = 64, std::uint32_t height = 32) {
    return {SphereFrame::around({0.2f, -0.5f, 0.8f}, {1, 2, -0.3f}), width, height};
}

TEST(SphereFrame, IsOrthonormalWhateverItIsMadeFrom) {
    std::mt19937 random(1);
    for (int i = 0; i < 1000; ++i) {
        const Vec3f pole = randomDirection(random);
        for (const Vec3f forward : {randomDirection(random), pole, -pole * 3.f, Vec3f{}}) {
            const SphereFrame frame = SphereFrame::around(pole * 7.f, forward);
            EXPECT_NEAR(length(frame.pole), 1, 1e-6);
            EXPECT_NEAR(length(frame.forward), 1, 1e-6);
            EXPECT_NEAR(dot(frame.pole, frame.forward), 0, 1e-6);
            EXPECT_NEAR(dot(frame.pole, pole), 1, 1e-6);
            EXPECT_TRUE(frame.isValid());
        }
    }
}

TEST(SphereMap, LooksAsAPersonDoes) {
    // Up is +z, forward +x: a person's right hand points to -y.
    const SphereMap map({{0, 0, 1}, {1, 0, 0}}, 8, 4);
    const auto expect = [&](Vec2d film, Vec3f direction) {
        const Vec3f found = map.direction(film);
        EXPECT_NEAR(length(found - direction), 0, 1e-6) << film.x << ", " << film.y;
    };
    expect({4, 2}, {1, 0, 0});
    expect({6, 2}, {0, -1, 0});
    expect({2, 2}, {0, 1, 0});
    expect({0, 2}, {-1, 0, 0});
    expect({3, 0}, {0, 0, 1});
    expect({3, 4}, {0, 0, -1});
    EXPECT_EQ(map.frame().right(), (Vec3f{0, -1, 0}));
}

TEST(SphereMap, GoesThereAndBack) {
    const SphereMap map = anyMap();
    std::mt19937 random(2);
    for (int i = 0; i < 10000; ++i) {
        const Vec3f direction = randomDirection(random);
        const Vec2d film = map.film(direction * 5.f);
        EXPECT_NEAR(length(map.direction(film) - direction), 0, 1e-6);
        EXPECT_GE(film.x, 0);
        EXPECT_LT(film.x, map.width());
    }
    // Straight back, where the map is cut open, and the poles.
    for (const Vec3f direction : {-map.frame().forward, map.frame().pole, -map.frame().pole}) {
        const Pixel pixel = map.pixelOf(direction);
        EXPECT_LT(pixel.x, map.width());
        EXPECT_LT(pixel.y, map.height());
    }
}

TEST(SphereMap, SolidAnglesAddUpToTheSphere) {
    for (const std::uint32_t height : {1u, 2u, 7u, 128u}) {
        const SphereMap map = anyMap(2 * height, height);
        double sum = 0;
        for (std::uint32_t row = 0; row < height; ++row) sum += map.solidAngle(row) * map.width();
        EXPECT_NEAR(sum, 4 * kPi, 1e-12);
    }
}

TEST(SphereMap, SamplesAreInTheirPixel) {
    const SphereMap map = anyMap(16, 8);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0.001f, 0.999f);
    for (std::uint32_t y = 0; y < map.height(); ++y)
        for (std::uint32_t x = 0; x < map.width(); ++x)
            for (int i = 0; i < 20; ++i) EXPECT_EQ(map.pixelOf(map.sample({x, y}, {uniform(random), uniform(random)})), (Pixel{x, y}));
}

TEST(SphereMap, SamplesAreUniformOverSolidAngle) {
    // Counts in bands of equal cosine within the top row, whose pixels are triangles on the sphere: chi-square with
    // 15 degrees of freedom, 99.9 % quantile 37.7.
    const SphereMap map(SphereFrame(), 4, 2);
    std::mt19937 random(4);
    std::uniform_real_distribution<float> uniform(0, 1);
    constexpr int kBands = 16, kSamples = 64000;
    int counts[kBands] = {};
    for (int i = 0; i < kSamples; ++i) {
        const Vec3f direction = map.sample({1, 0}, {uniform(random), uniform(random)});
        ++counts[std::min(kBands - 1, static_cast<int>(direction.z * kBands))];
    }
    double chi = 0;
    for (const int count : counts) chi += std::pow(count - kSamples / kBands, 2) / (kSamples / kBands);
    EXPECT_LT(chi, 37.7);
}

}  // namespace
}  // namespace emca::probe
