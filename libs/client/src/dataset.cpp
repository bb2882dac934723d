#include "emca/client/dataset.h"

#include <algorithm>

#include "notify.h"

namespace emca::client {

const ImageEntry* Dataset::currentImage() const {
    return currentImage_ < images_.size() ? &images_[currentImage_] : nullptr;
}

void Dataset::setInfo(std::optional<ServerInfo> info) {
    info_ = std::move(info);
    changed(DatasetPart::info);
}

void Dataset::setCamera(std::optional<Camera> camera) {
    camera_ = camera;
    changed(DatasetPart::camera);
}

void Dataset::setMeshes(std::shared_ptr<const std::vector<Mesh>> meshes) {
    meshes_ = std::move(meshes);
    changed(DatasetPart::meshes);
}

void Dataset::setSurface(std::shared_ptr<const SurfaceField> surface) {
    if (!surface && !surface_) return;
    surface_ = std::move(surface);
    changed(DatasetPart::surface);
}

std::size_t Dataset::addImage(ImageEntry image) {
    images_.push_back(std::move(image));
    currentImage_ = images_.size() - 1;
    changed(DatasetPart::images | DatasetPart::currentImage);
    return images_.size() - 1;
}

void Dataset::replaceImage(std::size_t index, ImageEntry image) {
    if (index >= images_.size()) return;
    images_[index] = std::move(image);
    changed(DatasetPart::images | (index == currentImage_ ? std::uint32_t(DatasetPart::currentImage) : 0u));
}

void Dataset::setCurrentImage(std::size_t index) {
    if (index >= images_.size() || index == currentImage_) return;
    currentImage_ = index;
    changed(DatasetPart::currentImage);
}

void Dataset::setImages(std::vector<ImageEntry> images, std::size_t current) {
    images_ = std::move(images);
    currentImage_ = images_.empty() ? 0 : std::min(current, images_.size() - 1);
    changed(DatasetPart::images | DatasetPart::currentImage);
}

void Dataset::pixelsChanged() { changed(DatasetPart::pixels); }

void Dataset::addTrace(std::shared_ptr<const Trace> trace) {
    if (!trace) return;
    std::erase(traces_, trace);
    traces_.insert(traces_.begin(), trace);
    if (traces_.size() > kHistory) traces_.resize(kHistory);
    std::uint64_t bytes = traces_.front()->stats.bytes;
    std::size_t kept = 1;
    while (kept < traces_.size() && bytes + traces_[kept]->stats.bytes <= kHistoryBytes) bytes += traces_[kept++]->stats.bytes;
    traces_.resize(kept);
    const Transaction once(*this);
    changed(DatasetPart::traces);
    setCurrent({std::move(trace)});
}

void Dataset::setTraces(std::vector<std::shared_ptr<const Trace>> traces) {
    std::erase(traces, nullptr);
    traces_ = std::move(traces);
    if (traces_.size() > kHistory) traces_.resize(kHistory);
    const Transaction once(*this);
    changed(DatasetPart::traces);
    setCurrent({});
}

void Dataset::setCurrent(std::vector<std::shared_ptr<const Trace>> traces) {
    std::vector<std::shared_ptr<const Trace>> next;
    for (auto& trace : traces) {
        if (trace && std::find(next.begin(), next.end(), trace) == next.end()) next.push_back(std::move(trace));
    }
    if (next == current_) return;
    current_ = std::move(next);
    if (current_.size() == 1) {
        paths_ = current_.front()->paths;  // shares the columns
    } else {
        std::vector<PathSet> sets;
        for (const auto& trace : current_) sets.push_back(trace->paths);
        paths_ = PathSet::merged(sets);
    }
    changed(DatasetPart::currentTrace);
}

void Dataset::clearScene() {
    camera_.reset();
    meshes_.reset();
    const bool hadSurface = surface_ != nullptr;
    surface_.reset();
    traces_.clear();
    current_.clear();
    paths_ = {};
    for (ImageEntry& image : images_) image.renderId = 0;
    std::uint32_t parts = DatasetPart::camera | DatasetPart::meshes | DatasetPart::traces | DatasetPart::currentTrace;
    if (hadSurface) parts |= DatasetPart::surface;
    if (!images_.empty()) parts |= DatasetPart::images;
    changed(parts);
}

Dataset::ListenerId Dataset::listen(Listener listener) {
    listeners_.emplace_back(nextListener_, std::move(listener));
    return nextListener_++;
}

void Dataset::unlisten(ListenerId id) {
    std::erase_if(listeners_, [id](const auto& entry) { return entry.first == id; });
}

void Dataset::changed(std::uint32_t parts) {
    pending_ |= parts;
    if (transactions_ == 0) notifyListeners(listeners_, pending_, notifying_);
}

Dataset::Transaction::Transaction(Dataset& dataset) : dataset_(dataset) { ++dataset_.transactions_; }

Dataset::Transaction::~Transaction() {
    if (--dataset_.transactions_ == 0) notifyListeners(dataset_.listeners_, dataset_.pending_, dataset_.notifying_);
}

}  // namespace emca::client
