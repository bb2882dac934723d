#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>

#include "emca/core/image.h"
#include "emca/protocol/messages.h"

namespace emca {

/// A finished image with the settings that made it.
struct KeptImage {
    std::uint64_t id = 0;
    protocol::Settings settings;   ///< complete
    double seconds = 0;
    RenderedImage image;
};

/// The last finished images, for verdicts. Thread-safe.
class ImageStore {
  public:
    explicit ImageStore(std::size_t most);

    /// Gives the image its id; the oldest is forgotten.
    std::shared_ptr<const KeptImage> add(protocol::Settings settings, double seconds, RenderedImage image);
    std::shared_ptr<const KeptImage> find(std::uint64_t id) const;
    /// The newest image that was rendered with what `wanted` says; what it leaves open (0, empty) matches anything.
    std::shared_ptr<const KeptImage> latestMatching(const protocol::Settings& wanted) const;
    std::uint64_t latest() const;  ///< id, 0 if none

  private:
    mutable std::mutex mutex_;
    std::deque<std::shared_ptr<const KeptImage>> images_;  // oldest first
    std::size_t most_;
    std::uint64_t nextId_;
};

/// Whether an image made with `complete` settings is one that `wanted` asks for.
bool matches(const protocol::Settings& wanted, const protocol::Settings& complete);
/// `wanted` with everything that it leaves open taken from `source`.
protocol::Settings filled(protocol::Settings wanted, const protocol::Settings& source);

}  // namespace emca
