#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emca/client/connection.h"

namespace emca::client {

/// An image that can be looked at and clicked: a render, or a file that a person opened.
struct ImageEntry {
    std::string title;                      ///< "render 3, 64 spp" or the file's name
    std::shared_ptr<const RenderedImage> image;  ///< of opened files only `color` is filled, with the file's channels
    std::uint64_t renderId = 0;             ///< 0 for opened files
    std::uint32_t samplesPerPixel = 0;      ///< 0 if unknown
    std::uint64_t seed = 0;
    std::string integrator, sampler;
    bool preview = false;                   ///< still rendering: pixels arrive tile by tile
};

/// Parts of a Dataset, as bits, so that a view reloads only what changed.
struct DatasetPart {
    enum : std::uint32_t { info = 1, camera = 2, meshes = 4, images = 8, currentImage = 16, traces = 32, currentTrace = 64, pixels = 128,
           surface = 256 };
};

/// Everything that was received, and nothing else: the one model beside Selection that all views read (brushing and
/// linking, thesis section 4.6.1). Not thread-safe: it belongs to the thread that shows it; what other threads receive
/// is handed over to that thread first. Its contents are immutable and shared, so that views may keep them.
class Dataset {
  public:
    using Listener = std::function<void(std::uint32_t parts)>;
    using ListenerId = std::uint64_t;

    const std::optional<ServerInfo>& info() const { return info_; }
    const std::optional<Camera>& camera() const { return camera_; }
    std::shared_ptr<const std::vector<Mesh>> meshes() const { return meshes_; }  ///< null before they came
    std::shared_ptr<const SurfaceField> surface() const { return surface_; }     ///< 3D data on `meshes`; null if none
    const std::vector<ImageEntry>& images() const { return images_; }
    const ImageEntry* currentImage() const;   ///< null if none
    std::size_t currentImageIndex() const { return currentImage_; }

    /// What was traced so far, pixels and regions, newest first: the pixel history. At most `kHistory`; and the oldest go
    /// where all together hold more than `kHistoryBytes` of recorded data (RecordingStats::bytes).
    const std::vector<std::shared_ptr<const Trace>>& traces() const { return traces_; }
    static constexpr std::size_t kHistory = 64;
    static constexpr std::uint64_t kHistoryBytes = std::uint64_t(1) << 30;
    /// The traces that the views show; usually one, several for a region or chosen pixels together.
    const std::vector<std::shared_ptr<const Trace>>& current() const { return current_; }
    /// Their paths in one set: what every path view shows. Empty if nothing is traced.
    const PathSet& paths() const { return paths_; }

    // Each tells the listeners once (or once at the end of a Transaction). Indices without an image and null traces are
    // ignored, and nobody is told.
    void setInfo(std::optional<ServerInfo> info);
    void setCamera(std::optional<Camera> camera);
    void setMeshes(std::shared_ptr<const std::vector<Mesh>> meshes);
    /// Replaces the layers that are there. Null: no layers.
    void setSurface(std::shared_ptr<const SurfaceField> surface);
    std::size_t addImage(ImageEntry image);                   ///< becomes current; returns its index
    void replaceImage(std::size_t index, ImageEntry image);
    void setCurrentImage(std::size_t index);
    /// Replaces all images. \param current  the last one if there is none of that index
    void setImages(std::vector<ImageEntry> images, std::size_t current);
    /// The pixels of the current preview changed.
    void pixelsChanged();
    void addTrace(std::shared_ptr<const Trace> trace);        ///< becomes the only current one
    /// Replaces the history, newest first; none is current. Null ones are left out.
    void setTraces(std::vector<std::shared_ptr<const Trace>> traces);
    /// Duplicates count once. Where two hold the same path, that of the later one is shown.
    void setCurrent(std::vector<std::shared_ptr<const Trace>> traces);
    /// Forgets scene, surface layers and traces, keeps info and images: another renderer was connected. The images lose their render
    /// ids, which mean nothing to it; their colours can still be traced against.
    void clearScene();

    /// Listeners may add and remove listeners (themselves too) and change the data while they are called; such a change
    /// is told to all of them after the running round.
    ListenerId listen(Listener listener);
    void unlisten(ListenerId id);

    /// While one lives, changes are collected; its end tells each listener once.
    class Transaction {
      public:
        explicit Transaction(Dataset& dataset);
        ~Transaction();
        Transaction(const Transaction&) = delete;
        Transaction& operator=(const Transaction&) = delete;
      private:
        Dataset& dataset_;
    };

  private:
    void changed(std::uint32_t parts);
    std::optional<ServerInfo> info_;
    std::optional<Camera> camera_;
    std::shared_ptr<const std::vector<Mesh>> meshes_;
    std::shared_ptr<const SurfaceField> surface_;
    std::vector<ImageEntry> images_;
    std::size_t currentImage_ = 0;
    std::vector<std::shared_ptr<const Trace>> traces_, current_;
    PathSet paths_;
    std::vector<std::pair<ListenerId, Listener>> listeners_;
    ListenerId nextListener_ = 1;
    int transactions_ = 0;
    std::uint32_t pending_ = 0;
    bool notifying_ = false;
};

}  // namespace emca::client
