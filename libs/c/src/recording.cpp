#include "emca/recorder/recording.h"

#include <optional>
#include <thread>

#include "emca/core/path_set.h"
#include "recording_handle.h"
#include "sized.h"

using namespace emca;

struct emca_scope {
    emca_scope(Recording& recording, const emca_pixel* pixel, emca_scope* outerScope)
        : thread(std::this_thread::get_id()), outer(outerScope) {
        if (pixel != nullptr)
            scope.emplace(recording, c::pixel(*pixel));
        else
            scope.emplace(recording);
    }
    std::thread::id thread;
    emca_scope* outer;  ///< of the same thread
    std::optional<RecordScope> scope;
};

namespace {
constinit thread_local emca_scope* innermost = nullptr;
}

extern "C" {

emca_code emca_scope_open(emca_recording* recording, const emca_pixel* pixel, emca_scope** scope, emca_error* error) {
    if (scope == nullptr)
        return c::invalid(error, "emca_scope_open was given null for the scope: pass the address of a pointer.");
    *scope = nullptr;
    if (recording == nullptr)
        return c::invalid(error, "emca_scope_open was given no recording: pass the one that render_pixel got.");
    if (recording->finished)
        return c::invalid(error, "emca_scope_open was given a recording that is finished: make a new one.");
    return c::guarded(error, [&] {
        innermost = *scope = new emca_scope(*recording->recording, pixel, innermost);
        return EMCA_OK;
    });
}

emca_code emca_scope_close(emca_scope* scope, emca_error* error) {
    if (scope == nullptr) return EMCA_OK;
    if (scope->thread != std::this_thread::get_id())
        return c::invalid(
            error, "emca_scope_close was called by another thread than the one that opened the scope: close it there.");
    if (scope != innermost)
        return c::invalid(
            error, "emca_scope_close was given a scope inside of which another one is open: close that one first.");
    innermost = scope->outer;
    return c::guarded(error, [&] {
        delete scope;
        return EMCA_OK;
    });
}

emca_code emca_recording_create(uint64_t budget, emca_recording** recording, emca_error* error) {
    if (recording == nullptr)
        return c::invalid(error,
                          "emca_recording_create was given null for the recording: pass the address of a pointer.");
    *recording = nullptr;
    return c::guarded(error, [&] {
        RecordingOptions options;
        if (budget != 0) options.budgetBytes = budget;
        *recording = new emca_recording(std::make_unique<Recording>(std::move(options)));
        return EMCA_OK;
    });
}

emca_code emca_recording_finish(emca_recording* recording, emca_recording_counts* counts, emca_error* error) {
    if (recording == nullptr || recording->own == nullptr)
        return c::invalid(
            error, "emca_recording_finish needs a recording of emca_recording_create; the server finishes its own.");
    if (recording->finished) return c::invalid(error, "emca_recording_finish was called a second time.");
    return c::guarded(error, [&]() -> emca_code {
        const auto asked =
            c::sized(counts, EMCA_SIZE_UP_TO(emca_recording_counts, dropped_without_vertex), "emca_recording_counts");
        if (!asked) return c::fail(error, asked.error());
        recording->finished = true;
        const auto paths = recording->own->finish();
        if (!paths) return c::fail(error, paths.error());
        const PathColumns& columns = paths->columns();
        const RecordingStats stats = recording->own->stats();
        emca_recording_counts found = *asked;
        found.paths = paths->pathCount();
        found.vertices = paths->vertexCount();
        found.columns = columns.columns.size();
        found.values = 0;
        for (const Column& column : columns.columns) found.values += column.count;
        found.contributions = columns.contributions.size();
        found.next_events = columns.nextEvents.size();
        found.splats = columns.splats.size();
        found.bytes = stats.bytes;
        found.dropped_by_budget = stats.droppedByBudget;
        found.dropped_without_path = stats.droppedWithoutPath;
        found.dropped_without_vertex = stats.droppedWithoutVertex;
        std::memcpy(counts, &found, asked->size < sizeof found ? asked->size : sizeof found);
        return EMCA_OK;
    });
}

void emca_recording_destroy(emca_recording* recording) {
    if (recording != nullptr && recording->own != nullptr) delete recording;
}

}  // extern "C"
