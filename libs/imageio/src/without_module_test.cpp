// A program that cannot find the module of image formats: linked without RUNPATH, in a folder of its own.
#include <cstdlib>

#include "emca/imageio/imageio.h"
#include "emca/imageio/stored_image.h"
#include "testing/image_files.h"

namespace emca::imageio {
namespace {

void expectSentence(const Error& error, const std::string& file) {
    EXPECT_EQ(error.code, ErrorCode::notSupported);
    for (const std::string& part : {file, std::string("libemca_image_formats.so"), std::string("install")})
        EXPECT_NE(error.message.find(part), std::string::npos) << error.message;
    EXPECT_EQ(error.message.find('\n'), std::string::npos);
    EXPECT_EQ(error.message.back(), '.');
}

TEST_F(ImageFiles, OtherFormatsSayWhatIsMissing) {
    ASSERT_EQ(std::getenv("LD_LIBRARY_PATH"), nullptr) << "the module might be found there";
    writeBytes(file("a.png"), "\x89PNG\r\n\x1a\n");
    prepareFor(file("a.png"));
    for (int again = 0; again < 2; ++again) {
        expectSentence(read(file("a.png")).error(), "a.png");
        expectSentence(readStored(file("a.png")).error(), "a.png");
        for (const char* name : {"b.png", "b.hdr"}) {
            expectSentence(checkWritable(file(name)).error(), name);
            expectSentence(write(file(name), Image(2, 2)).error(), name);
        }
    }
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(ImageFiles, ExrAndPfmNeedNothing) {
    for (const char* name : {"a.exr", "a.pfm"}) {
        prepareFor(file(name));
        EXPECT_TRUE(checkWritable(file(name)).ok());
        ASSERT_TRUE(write(file(name), randomBits(8, 8)).ok());
        EXPECT_TRUE(sameBits(*read(file(name)), randomBits(8, 8)));
        EXPECT_EQ(readStored(file(name))->floats.size(), 192u);
    }
}

TEST_F(ImageFiles, MissingFilesAreStillMissing) {
    EXPECT_EQ(read(file("none.png")).error().code, ErrorCode::fileNotFound);
}

}  // namespace
}  // namespace emca::imageio
