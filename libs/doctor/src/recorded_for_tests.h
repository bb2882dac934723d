#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "emca/recorder/recorder.h"
#include "emca/recorder/recording.h"

namespace emca::doctor {

/// What `record` records for a pixel.
inline PathSet recorded(Pixel pixel, const std::function<void(PathRecorder&)>& record) {
    Recording recording({.pixels = {pixel}});
    {
        const RecordScope scope(recording, pixel);
        record(recorder());
    }
    auto paths = recording.finish();
    EXPECT_TRUE(paths.ok());
    return paths ? std::move(paths).value() : PathSet();
}

}  // namespace emca::doctor
