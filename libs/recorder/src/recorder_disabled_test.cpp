// The same calls in a renderer that was built with EMCA_DISABLED.
#define EMCA_DISABLED
#include <gtest/gtest.h>

#include "emca/recorder/recorder.h"

namespace emca {
namespace {

TEST(RecorderDisabled, NothingIsRecordedEvenInsideAScope) {
    Recording recording;
    bool evaluated = false;
    {
        const RecordScope scope(recording, {0, 0});
        PathRecorder& emca = recorder();
        EXPECT_FALSE(emca.isRecording());
        emca.setPathIndex(0);
        emca.addPathData("costly", [&] { evaluated = true; return 1; });
    }
    EXPECT_FALSE(evaluated);
    auto paths = recording.finish();
    ASSERT_TRUE(paths.ok());
    EXPECT_EQ(paths->pathCount(), 0u);
}

}  // namespace
}  // namespace emca
