#include "emca/adapter/exchanged.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

namespace emca::adapter {
namespace {

static_assert(!std::is_copy_constructible_v<Exchanged<int>> && !std::is_copy_assignable_v<Exchanged<int>>);

TEST(Exchanged, AVariableHasAnotherValueWhileItLives) {
    const int first = 1, second = 2;
    const int* current = nullptr;
    {
        const Exchanged outer(current, &first);
        EXPECT_EQ(current, &first);
        {
            const Exchanged inner(current, &second);
            EXPECT_EQ(current, &second);
            {
                const Exchanged nobody(current, nullptr);
                EXPECT_EQ(current, nullptr);
            }
            EXPECT_EQ(current, &second);
        }
        EXPECT_EQ(current, &first);
    }
    EXPECT_EQ(current, nullptr);
}

TEST(Exchanged, WhatWasThereComesBackWhenSomethingIsThrown) {
    int depth = 3;
    try {
        const Exchanged deeper(depth, 4);
        throw std::runtime_error(std::to_string(depth));
    } catch (const std::runtime_error& e) {
        EXPECT_STREQ(e.what(), "4");
    }
    EXPECT_EQ(depth, 3);
}

TEST(Exchanged, MovesWhatCannotBeCopied) {
    auto owner = std::make_unique<int>(1);
    const int* const own = owner.get();
    {
        const Exchanged other(owner, std::make_unique<int>(2));
        EXPECT_EQ(*owner, 2);
    }
    EXPECT_EQ(owner.get(), own);
}

}  // namespace
}  // namespace emca::adapter
