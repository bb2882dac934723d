#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emca/protocol/frame.h"
#include "emca/protocol/messages.h"
#include "wire.h"

namespace emca::protocol {

/// Turns parts of one verified frame into values. The FlatBuffers verifier promises that offsets and lengths stay inside
/// the frame; what it does not promise is watched here: that copies do not outgrow the frame (many offsets may name
/// one string) and that 8-byte values are aligned. The first fault is remembered and fails the whole message.
class Decoder {
  public:
    explicit Decoder(const Frame& frame) : frame_(frame), copiesLeft_(frame.size()) {}

    void fail(std::string what) { if (fault_.empty()) fault_ = std::move(what); }
    bool failed() const { return !fault_.empty(); }
    const std::string& fault() const { return fault_; }

    std::string text(const flatbuffers::String* string) {
        if (!string || !mayCopy(string->size())) return {};
        return string->str();
    }
    std::vector<std::string> texts(const flatbuffers::Vector<flatbuffers::Offset<flatbuffers::String>>* list) {
        std::vector<std::string> result;
        if (!list || !mayCopy(std::size_t(list->size()) * sizeof(flatbuffers::uoffset_t))) return result;
        result.reserve(list->size());
        for (const auto* string : *list) result.push_back(text(string));
        return result;
    }
    template <typename Core, typename WireType>
    SharedArray<Core> view(const flatbuffers::Vector<WireType>* vector) {
        if (!vector || vector->size() == 0) return {};
        const auto* data = vector->Data();
        if (reinterpret_cast<std::uintptr_t>(data) % alignof(Core) != 0) {
            fail("a column is not aligned");
            return {};
        }
        return {frame_.owner(), reinterpret_cast<const Core*>(data), vector->size()};
    }
    template <typename Core, typename WireType>
    std::vector<Core> copy(const flatbuffers::Vector<WireType>* vector) {
        const SharedArray<Core> values = view<Core>(vector);
        if (!mayCopy(values.size() * sizeof(Core))) return {};
        return {values.begin(), values.end()};
    }
    /// A structure that is read in place; null if it is absent or, which the verifier does not look at, lies askew.
    template <typename Struct>
    const Struct* aligned(const void* at) {
        if (reinterpret_cast<std::uintptr_t>(at) % alignof(Struct) == 0) return static_cast<const Struct*>(at);
        fail("an entry is not aligned");
        return nullptr;
    }
    template <typename Enum>
    Enum enumeration(std::uint8_t value, Enum last, const char* what) {
        if (value > static_cast<std::uint8_t>(last)) {
            fail(std::string("there is no ") + what + " " + std::to_string(value));
            return Enum{};
        }
        return static_cast<Enum>(value);
    }

  private:
    bool mayCopy(std::size_t bytes) {
        if (bytes > copiesLeft_) {
            fail("its parts overlap");
            return false;
        }
        copiesLeft_ -= bytes;
        return true;
    }
    const Frame& frame_;
    std::size_t copiesLeft_;
    std::string fault_;
};

/// Layers of a kind that only later versions know are left out, or fail the message where what follows counts them.
std::vector<Layer> decodeLayers(Decoder& decoder, const flatbuffers::Vector<flatbuffers::Offset<wire::Layer>>* layers,
                                bool everyKindMustBeKnown = false);
SurfaceCounts decodeCounts(Decoder& decoder, const wire::SurfaceCounts* counts);
SurfaceResult decodeSurface(Decoder& decoder, const wire::SurfaceResult& message);
SurfaceChunk decodeSurface(Decoder& decoder, const wire::SurfaceChunk& message);

PathSet decodePaths(Decoder& decoder, const wire::Paths* paths);

}  // namespace emca::protocol
