// Bytes that nobody should send: refused or cleanly decoded, never a crash. Run under ASan and UBSan in CI, where a
// read outside the frame or a misaligned one ends the test.
#include <gtest/gtest.h>

#include <cstring>

#include "emca/protocol/codec.h"
#include "emca_generated.h"
#include "sample_messages.h"

namespace emca::protocol {
namespace {

/// In memory of exactly this size, so that ASan sees the first byte too far.
Frame exact(const std::byte* bytes, std::size_t size) {
    auto memory = allocatePayload(size);
    std::memcpy(memory->get(), bytes, size);
    const std::byte* data = memory->get();
    return Frame(std::move(memory).value(), data, size);
}

/// Touches all that a view would read; the sum keeps the compiler from leaving it out.
double readEverything(const PathSet& paths) {
    double sum = 0;
    for (Index p = 0; p < paths.pathCount(); ++p) {
        sum += paths.depth(p) + paths.splats(p).size();
        if (const auto e = paths.estimate(p)) sum += e->r > 0 ? 1 : 0;
        for (Index v = paths.vertices(p).first; v < paths.vertices(p).last; ++v) {
            sum += paths.pathOf(v) + paths.nextEvents(v).size();
            if (const auto s = paths.scattering(v)) sum += static_cast<double>(s->label.size());
            for (Index c = paths.contributions(v).first; c < paths.contributions(v).last; ++c) {
                sum += static_cast<double>(paths.text(paths.contribution(c).technique).size());
            }
        }
    }
    for (const Column& column : paths.userColumns()) {
        for (Index i = 0; i < column.count; ++i) sum += static_cast<double>(paths.value(column, i).index() + column.owner(i));
    }
    return sum;
}

bool decodesCleanly(const Frame& frame) {
    const auto message = decode(frame);
    if (!message) {
        EXPECT_EQ(message.error().code, ErrorCode::protocolViolation);
        EXPECT_FALSE(message.error().message.empty());
        return false;
    }
    if (const auto* trace = std::get_if<TraceResult>(&message->body)) {
        EXPECT_GE(readEverything(trace->paths), 0);
        EXPECT_EQ(trace->pixels.size(), trace->replays.size());
    }
    if (const auto* chunk = std::get_if<SurfaceChunk>(&message->body)) {
        double sum = 0;
        for (const SurfaceMeshPart& part : chunk->meshes) for (const std::uint8_t byte : part.bits) sum += byte;
        for (const SurfaceArrayPart& part : chunk->arrays) for (const float value : part.values) sum += value > 0 ? 1 : 0;
        EXPECT_GE(sum, 0);
    }
    const bool known = !std::holds_alternative<Unknown>(message->body);
    EXPECT_EQ(encode(*message).ok(), known);
    return true;
}

TEST(Hostile, EveryTruncationOfEveryMessageIsRefusedOrLosesNothing) {
    for (const Message& message : test::everyMessage()) {
        const auto frame = encode(message);
        ASSERT_TRUE(frame.ok());
        for (std::size_t size = 0; size < frame->size(); ++size) {
            const Frame cut = exact(frame->data(), size);
            if (!decodesCleanly(cut)) continue;
            // Only padding at the end can be missing.
            const auto again = encode(*decode(cut));
            ASSERT_TRUE(again.ok());
            ASSERT_GT(size + 16, frame->size()) << "kind " << message.body.index();
            ASSERT_EQ(again->size(), frame->size());
            ASSERT_EQ(std::memcmp(again->data(), frame->data(), frame->size()), 0);
        }
        EXPECT_TRUE(decodesCleanly(exact(frame->data(), frame->size())));
    }
}

TEST(Hostile, MutationsNeverCrash) {
    std::vector<Frame> frames;
    for (const Message& message : test::everyMessage()) frames.push_back(*encode(message));
    test::Source source(2026);
    int decoded = 0;
    constexpr int kMutations = 24000;
    for (int i = 0; i < kMutations; ++i) {
        // Half of them on paths, where most of the structure is.
        const Frame& original = source.coin() ? frames[18] : frames[source.below(static_cast<std::uint32_t>(frames.size()))];
        Frame mutant = exact(original.data(), original.size());
        auto* bytes = const_cast<std::byte*>(mutant.data());
        const auto size = static_cast<std::uint32_t>(mutant.size());
        for (std::uint32_t n = 1 + source.below(3); n > 0; --n) {
            const std::uint32_t at = source.below(size);
            switch (source.below(3)) {
                case 0: bytes[at] ^= std::byte(1u << source.below(8)); break;
                case 1: bytes[at] = std::byte(source.below(256)); break;
                default: {  // an offset, length or index that is far off
                    const std::uint32_t words[] = {0, 1, 0x7fffffff, 0xffffffff, size, size - 4, source.below(size), 0xfffffffc};
                    const std::uint32_t word = words[source.below(8)];
                    if (const std::uint32_t place = at & ~3u; place + 4 <= size) std::memcpy(bytes + place, &word, 4);
                }
            }
        }
        decoded += decodesCleanly(mutant) ? 1 : 0;
    }
    EXPECT_GT(decoded, kMutations / 100) << "most of a message is numbers: many mutations must still decode";
    EXPECT_LT(decoded, kMutations) << "and others must be noticed";
}

TEST(Hostile, StringsThatShareTheirBytesCannotBlowUpMemory) {
    // A list of 200,000 offsets that all name one string of 64 KiB: 800 kB that would become 13 GB.
    flatbuffers::FlatBufferBuilder builder;
    const auto text = builder.CreateString(std::string(65536, 'x'));
    const std::vector<flatbuffers::Offset<flatbuffers::String>> list(200000, text);
    const auto layers = builder.CreateVector(list);
    const auto body = wire::CreateSurfaceRequest(builder, layers);
    builder.Finish(wire::CreateMessage(builder, 1, wire::Body::SurfaceRequest, body.Union()), wire::MessageIdentifier());
    const auto message = decode(exact(reinterpret_cast<const std::byte*>(builder.GetBufferPointer()), builder.GetSize()));
    ASSERT_FALSE(message.ok());
    EXPECT_EQ(message.error().code, ErrorCode::protocolViolation);
}

TEST(Hostile, EightByteColumnsThatAreNotAlignedAreRefused) {
    // The same three paths twice; 4 bytes more at the end move the column of 64-bit samples by half its alignment.
    int decoded = 0;
    for (const bool moved : {false, true}) {
        flatbuffers::FlatBufferBuilder builder;
        if (moved) builder.PushElement<std::uint32_t>(7);
        const std::int64_t samples[] = {1, 2, 3};
        std::uint8_t* place = nullptr;
        const auto fours = builder.CreateUninitializedVector(6, 4, &place);  // 24 bytes, aligned to 4 only
        std::memcpy(place, samples, sizeof samples);
        flatbuffers::WriteScalar<flatbuffers::uoffset_t>(place - 4, 3);
        const flatbuffers::Offset<flatbuffers::Vector<std::int64_t>> sampleColumn(fours);
        const std::vector<wire::Pixel> pixels(3, wire::Pixel(0, 0));
        const auto pixelColumn = builder.CreateVectorOfStructs(pixels);
        const auto parts = builder.CreateVector(std::vector<std::int32_t>(3));
        const auto flags = builder.CreateVector(std::vector<std::uint8_t>(3));
        const auto first = builder.CreateVector(std::vector<std::uint32_t>(4));
        const auto paths = wire::CreatePaths(builder, pixelColumn, sampleColumn, parts, flags, 0, 0, first);
        const auto body = wire::CreateTraceResult(builder, 0, 0, 0, 0, nullptr, 0, paths);
        builder.Finish(wire::CreateMessage(builder, 1, wire::Body::TraceResult, body.Union()), wire::MessageIdentifier());
        const auto message = decode(exact(reinterpret_cast<const std::byte*>(builder.GetBufferPointer()), builder.GetSize()));
        if (message.ok()) {
            ++decoded;
            EXPECT_EQ(std::get<TraceResult>(message->body).paths.sample(2), 3);
        } else {
            EXPECT_NE(message.error().message.find("aligned"), std::string::npos) << message.error().message;
        }
    }
    EXPECT_EQ(decoded, 1);
}

TEST(Hostile, NumbersOutsideTheirEnumerationAreRefused) {
    flatbuffers::FlatBufferBuilder builder;
    const auto request = wire::CreateTraceRequest(builder, 0, nullptr, 0, 200);
    builder.Finish(wire::CreateMessage(builder, 1, wire::Body::TraceRequest, request.Union()), wire::MessageIdentifier());
    EXPECT_FALSE(decode(exact(reinterpret_cast<const std::byte*>(builder.GetBufferPointer()), builder.GetSize())).ok());
}

TEST(Hostile, AKindOfALaterVersionIsKnownToBeUnknown) {
    flatbuffers::FlatBufferBuilder builder;
    const auto body = wire::CreateDone(builder);
    builder.Finish(wire::CreateMessage(builder, 77, static_cast<wire::Body>(200), body.Union()), wire::MessageIdentifier());
    const auto message = decode(exact(reinterpret_cast<const std::byte*>(builder.GetBufferPointer()), builder.GetSize()));
    ASSERT_TRUE(message.ok()) << message.error().message;
    EXPECT_EQ(message->request, 77u);
    ASSERT_TRUE(std::holds_alternative<Unknown>(message->body));
    EXPECT_EQ(std::get<Unknown>(message->body).kind, 200);
}

TEST(Hostile, AnotherProgramsFlatBufferIsRefused) {
    const auto frame = encode({1, Done{}});
    Frame other = exact(frame->data(), frame->size());
    std::memcpy(const_cast<std::byte*>(other.data()) + 4, "EMCB", 4);
    const auto message = decode(other);
    ASSERT_FALSE(message.ok());
    EXPECT_NE(message.error().message.find("EMCA"), std::string::npos);
}

}  // namespace
}  // namespace emca::protocol
