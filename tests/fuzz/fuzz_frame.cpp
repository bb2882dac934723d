// Any payload: refused, or decoded so that everything in it can be read and encoded again.
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "emca/protocol/codec.h"

namespace {

double readEverything(const emca::PathSet& paths) {
    double sum = 0;
    for (emca::Index p = 0; p < paths.pathCount(); ++p) {
        sum += paths.depth(p) + paths.splats(p).size();
        const emca::IndexRange range = paths.vertices(p);
        for (emca::Index v = range.first; v < range.last; ++v) {
            sum += paths.nextEvents(v).size();
            if (const auto s = paths.scattering(v)) sum += static_cast<double>(s->label.size());
            const emca::IndexRange list = paths.contributions(v);
            for (emca::Index c = list.first; c < list.last; ++c) {
                sum += static_cast<double>(paths.text(paths.contribution(c).technique).size());
            }
        }
    }
    for (const emca::Column& column : paths.userColumns()) {
        for (emca::Index i = 0; i < column.count; ++i) sum += static_cast<double>(paths.value(column, i).index() + column.owner(i));
    }
    return sum;
}

double readEverything(const emca::protocol::SurfaceChunk& chunk) {
    double sum = 0;
    for (const auto& part : chunk.meshes) for (const std::uint8_t byte : part.bits) sum += byte;
    for (const auto& part : chunk.arrays) for (const float value : part.values) sum += static_cast<double>(value);
    return sum;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    auto memory = emca::protocol::allocatePayload(size);  // exactly this size, so that ASan sees the first byte too far
    if (!memory) return 0;
    std::memcpy(memory->get(), data, size);
    const std::byte* bytes = memory->get();
    const auto message = emca::protocol::decode(emca::protocol::Frame(*memory, bytes, size));
    if (!message) return 0;
    if (const auto* trace = std::get_if<emca::protocol::TraceResult>(&message->body)) {
        volatile double sum = readEverything(trace->paths);
        (void)sum;
    }
    if (const auto* chunk = std::get_if<emca::protocol::SurfaceChunk>(&message->body)) {
        volatile double sum = readEverything(*chunk);
        (void)sum;
    }
    if (std::holds_alternative<emca::protocol::Unknown>(message->body)) return 0;
    const auto first = emca::protocol::encode(*message);
    if (!first) std::abort();
    const auto again = emca::protocol::decode(*first);
    if (!again) std::abort();
    const auto second = emca::protocol::encode(*again);
    if (!second || second->size() != first->size() || std::memcmp(first->data(), second->data(), first->size()) != 0) std::abort();
    return 0;
}
