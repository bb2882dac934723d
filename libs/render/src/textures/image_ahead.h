#pragma once

#include <tbb/task_group.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "textures/texture_image.h"

namespace emca::render {

/// An image that is read by another thread while its scene is built. One thread waits for it.
class ImageAhead {
  public:
    using Image = Result<std::shared_ptr<const TextureImage>>;

    ImageAhead(std::filesystem::path file, TextureImage::Options options) {
        group_.run([this, file = std::move(file), options = std::move(options)] {
            image_ = TextureImage::read(file, options);
        });
    }
    ~ImageAhead() { group_.wait(); }
    ImageAhead(const ImageAhead&) = delete;
    ImageAhead& operator=(const ImageAhead&) = delete;

    /// Waits, and meanwhile helps with other images.
    const Image& wait() {
        group_.wait();
        return *image_;
    }

  private:
    std::optional<Image> image_;
    tbb::task_group group_;
};

}  // namespace emca::render
