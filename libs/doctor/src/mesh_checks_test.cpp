#include <gtest/gtest.h>

#include <cmath>

#include "emca/doctor/scene_checks.h"

namespace emca::doctor {
namespace {

Mesh triangle(const char* name) {
    Mesh mesh;
    mesh.name = name;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

TEST(MeshChecks, ASoundSceneIsWell) {
    Mesh other = triangle("b");
    other.positions[0].z = 1;
    const Finding finding = checkMeshes({triangle("a"), other}, 2, 2);
    EXPECT_EQ(finding.outcome, Outcome::ok);
    EXPECT_EQ(finding.sentence, "2 triangles in 2 meshes, 0 of them without area; the box is 2.000 x 3.000 x 1.000.");
    EXPECT_EQ(finding.advice, "");
}

TEST(MeshChecks, EveryFaultIsCountedAndNamed) {
    std::vector<Mesh> meshes{triangle("a"), triangle("b"), triangle("c"), Mesh{}, triangle("e")};
    meshes[1].positions[2].x = INFINITY;
    meshes[1].positions[0].y = std::nanf("");
    meshes[2].triangles.push_back({0, 1, 3});
    meshes[2].triangles.push_back({1, 1, 2});
    const MeshFacts facts = inspect(meshes);
    EXPECT_EQ(facts.meshes, 5u);
    EXPECT_EQ(facts.triangles, 6u);
    EXPECT_EQ(facts.nonFinitePositions, 2u);
    EXPECT_EQ(facts.nonFiniteExample, "mesh 1 (b), vertex 0");
    EXPECT_EQ(facts.badIndices, 1u);
    EXPECT_EQ(facts.badIndexExample, "mesh 2 (c), triangle 1");
    EXPECT_EQ(facts.degenerate, 1u + 1u) << "the one with equal corners, and the one with a NaN";
    EXPECT_EQ(facts.empty, 1u);
    EXPECT_EQ(facts.emptyExample, "mesh 3");
    EXPECT_EQ(facts.duplicates, 1u);
    EXPECT_EQ(facts.duplicateExample, "mesh 4 (e) is mesh 0 (a)");
    EXPECT_EQ(checkMeshes(meshes, 5, 6).outcome, Outcome::failed);
}

TEST(MeshChecks, SliversHaveAreaWhateverTheUnit) {
    for (const float unit : {1e-15f, 1.f, 1e15f}) {
        Mesh mesh = triangle("a");
        for (Vec3f& p : mesh.positions) p *= unit;
        EXPECT_EQ(inspect({mesh}).degenerate, 0u) << unit;
        mesh.positions[2] = mesh.positions[1] * 0.5f;
        EXPECT_EQ(inspect({mesh}).degenerate, 1u) << unit;
    }
}

TEST(MeshChecks, WhatInfoSaysMustBeTrue) {
    EXPECT_EQ(checkMeshes({triangle("a")}, 1, 2).outcome, Outcome::failed);
    EXPECT_EQ(checkMeshes({triangle("a")}, 2, 1).outcome, Outcome::failed);
    EXPECT_EQ(checkMeshes({triangle("a")}, 1, 1).outcome, Outcome::ok);
    EXPECT_EQ(checkMeshes({}, 0, 0).outcome, Outcome::warning);
}

}  // namespace
}  // namespace emca::doctor
