#include "image_store.h"

#include <algorithm>
#include <random>

namespace emca {

bool matches(const protocol::Settings& wanted, const protocol::Settings& complete) {
    return (wanted.samplesPerPixel == 0 || wanted.samplesPerPixel == complete.samplesPerPixel) &&
           (!wanted.hasSeed || wanted.seed == complete.seed) &&
           (wanted.integrator.empty() || wanted.integrator == complete.integrator) &&
           (wanted.sampler.empty() || wanted.sampler == complete.sampler);
}

protocol::Settings filled(protocol::Settings wanted, const protocol::Settings& source) {
    if (wanted.samplesPerPixel == 0) wanted.samplesPerPixel = source.samplesPerPixel;
    if (wanted.integrator.empty()) wanted.integrator = source.integrator;
    if (wanted.sampler.empty()) wanted.sampler = source.sampler;
    if (!wanted.hasSeed) wanted.seed = source.seed;
    wanted.hasSeed = true;
    return wanted;
}

ImageStore::ImageStore(std::size_t most) : most_(std::max<std::size_t>(most, 1)) {
    // A client that reconnects to a restarted server must not meet another image under an old id. Below 2^53, so
    // that every JSON reader keeps it.
    std::random_device random;
    nextId_ = (std::uint64_t(random() & 0x7fffffffu) << 16) + 1;
}

std::shared_ptr<const KeptImage> ImageStore::add(protocol::Settings settings, double seconds, RenderedImage image) {
    const std::lock_guard lock(mutex_);
    auto kept = std::make_shared<const KeptImage>(KeptImage{nextId_++, std::move(settings), seconds, std::move(image)});
    images_.push_back(kept);
    while (images_.size() > most_) images_.pop_front();
    return kept;
}

std::shared_ptr<const KeptImage> ImageStore::find(std::uint64_t id) const {
    const std::lock_guard lock(mutex_);
    const auto it = std::find_if(images_.begin(), images_.end(), [id](const auto& kept) { return kept->id == id; });
    return it == images_.end() ? nullptr : *it;
}

std::shared_ptr<const KeptImage> ImageStore::latestMatching(const protocol::Settings& wanted) const {
    const std::lock_guard lock(mutex_);
    const auto it = std::find_if(images_.rbegin(), images_.rend(),
                                 [&](const auto& kept) { return matches(wanted, kept->settings); });
    return it == images_.rend() ? nullptr : *it;
}

std::uint64_t ImageStore::latest() const {
    const std::lock_guard lock(mutex_);
    return images_.empty() ? 0 : images_.back()->id;
}

}  // namespace emca
