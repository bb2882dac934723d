#include "quantities.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plugin/probe_steps.h"

namespace emca::intersection_data {
namespace {

const Quantity* find(const std::vector<Quantity>& all, const std::string& name) {
    for (const Quantity& quantity : all)
        if (quantity.name == name) return &quantity;
    return nullptr;
}

TEST(Quantities, EveryVertexColumnOfThePathAndNoOther) {
    const auto trace = explorer::sampleTrace();
    const auto all = quantitiesOf(trace->paths, 1);   // vertices 4 to 7
    ASSERT_EQ(all.size(), 6u);
    EXPECT_EQ(find(all, "left scene"), nullptr) << "belongs to the path";
    const Quantity& pdf = *find(all, "pdf");
    ASSERT_EQ(pdf.entries.size(), 4u);
    EXPECT_EQ(pdf.entries[0].vertex, 4u);
    EXPECT_FLOAT_EQ(float(pdf.entries[0].numbers[0]), 0.5f);
    EXPECT_TRUE(std::isinf(pdf.entries[1].numbers[0]));
    EXPECT_EQ(pdf.valueAt(5), "Infinity");
    EXPECT_EQ(pdf.valueAt(3), "") << "another path's";
}

TEST(Quantities, KindsAndWords) {
    const auto trace = explorer::sampleTrace();
    const auto all = quantitiesOf(trace->paths, 0);
    EXPECT_EQ(find(all, "bsdf weight")->kind, Kind::color);
    EXPECT_EQ(find(all, "random")->kind, Kind::point);
    EXPECT_EQ(find(all, "tries")->kind, Kind::scalar);
    EXPECT_TRUE(find(all, "tries")->integral);
    const Quantity& material = *find(all, "material");
    EXPECT_EQ(material.kind, Kind::text);
    EXPECT_EQ(material.words, (std::vector<std::string>{"diffuse", ""}));
    EXPECT_EQ(material.valueAt(0), "diffuse");
}

TEST(Quantities, SeveralValuesAtAVertexAreAllThereAndTheLastOneIsItsValue) {
    const auto trace = explorer::sampleTrace();
    const auto all = quantitiesOf(trace->paths, 0);
    const Quantity& repeated = *find(all, "repeated");
    ASSERT_EQ(repeated.entries.size(), 2u);
    EXPECT_EQ(repeated.valueAt(1), "2.000");
    EXPECT_EQ(find(quantitiesOf(trace->paths, 2), "repeated"), nullptr) << "no vertex of that path has it";
}

}  // namespace
}  // namespace emca::intersection_data
