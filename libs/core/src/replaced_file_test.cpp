#include "emca/core/replaced_file.h"

#include <gtest/gtest.h>

#include <iterator>

namespace emca {
namespace {

namespace fs = std::filesystem;

class ReplacedFileTest : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) / ("replaced_file." + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder_);
        ASSERT_TRUE(fs::create_directory(folder_));
    }
    void TearDown() override { fs::remove_all(folder_); }
    static std::string contents(const fs::path& file) {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    static void put(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }
    std::size_t filesThere() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }
    fs::path folder_;
};

TEST_F(ReplacedFileTest, TheOldFileStandsUntilTheNewOneIsComplete) {
    put(folder_ / "a.txt", "old");
    auto file = ReplacedFile::create(folder_ / "a.txt");
    ASSERT_TRUE(file.ok()) << file.error().message;
    file->stream() << "new and longer";
    file->stream().flush();
    EXPECT_EQ(contents(folder_ / "a.txt"), "old");
    EXPECT_EQ(file->temporary().parent_path(), folder_) << "a rename does not go from one disk to another";
    ASSERT_TRUE(file->commit().ok());
    EXPECT_EQ(contents(folder_ / "a.txt"), "new and longer");
    EXPECT_EQ(filesThere(), 1u);
}

TEST_F(ReplacedFileTest, WhatIsNotCommittedLeavesNothing) {
    put(folder_ / "a.txt", "old");
    {
        auto file = ReplacedFile::create(folder_ / "a.txt");
        ASSERT_TRUE(file.ok());
        file->stream() << "half";
        EXPECT_EQ(filesThere(), 2u);
    }
    EXPECT_EQ(contents(folder_ / "a.txt"), "old");
    EXPECT_EQ(filesThere(), 1u);
}

TEST_F(ReplacedFileTest, ALibraryMayWriteByName) {
    auto file = ReplacedFile::create(folder_ / "a.txt", "image");
    ASSERT_TRUE(file.ok());
    put(file->temporary(), "by name");
    ASSERT_TRUE(file->commit().ok());
    EXPECT_EQ(contents(folder_ / "a.txt"), "by name");
}

TEST_F(ReplacedFileTest, LinksStayAndPermissionsToo) {
    put(folder_ / "real.txt", "old");
    fs::permissions(folder_ / "real.txt", fs::perms::owner_read);
    fs::create_symlink("real.txt", folder_ / "link.txt");
    auto file = ReplacedFile::create(folder_ / "link.txt");
    ASSERT_TRUE(file.ok());
    put(file->temporary(), "new");
    EXPECT_EQ(fs::status(file->temporary()).permissions() & fs::perms::others_all, fs::perms::none);
    ASSERT_TRUE(file->commit().ok());
    EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
    EXPECT_EQ(contents(folder_ / "real.txt"), "new");
    EXPECT_EQ(fs::status(folder_ / "real.txt").permissions(), fs::perms::owner_read);
}

TEST_F(ReplacedFileTest, RefusalsNameTheFileAndTheReason) {
    const auto missing = ReplacedFile::create(folder_ / "none" / "a.txt", "session");
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().code, ErrorCode::fileUnwritable);
    EXPECT_EQ(missing.error().message, "The session " + (folder_ / "none" / "a.txt").string() + " cannot be written: there is no folder " +
                                           (folder_ / "none").string() + ".");
    const auto folder = ReplacedFile::check(folder_);
    ASSERT_FALSE(folder.ok());
    EXPECT_EQ(folder.error().message, "The file " + folder_.string() + " cannot be written: there is something of that name that is not a file.");
    EXPECT_TRUE(ReplacedFile::check(folder_ / "a.txt").ok());
    EXPECT_EQ(filesThere(), 0u) << "asking leaves nothing behind";
}

TEST_F(ReplacedFileTest, AFullDiskIsNoticed) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no device that is always full";
    put(folder_ / "a.txt", "old");
    auto file = ReplacedFile::create(folder_ / "a.txt");
    ASSERT_TRUE(file.ok());
    file->stream().close();
    file->stream().open("/dev/full", std::ios::binary);
    file->stream() << "new";
    const auto committed = file->commit();
    ASSERT_FALSE(committed.ok());
    EXPECT_NE(committed.error().message.find("the disk may be full"), std::string::npos);
    EXPECT_EQ(contents(folder_ / "a.txt"), "old");
}

}  // namespace
}  // namespace emca
