#pragma once

#include <memory>
#include <vector>

#include "emca/core/mesh.h"
#include "image_store.h"
#include "request.h"

namespace emca {

/// Meshes as SceneChunks of about `chunkBytes`; an empty scene is one empty chunk.
ClientPort::Source sceneChunks(std::shared_ptr<const std::vector<Mesh>> meshes, std::size_t chunkBytes);
/// The pixels of an image as ImageRows of about `chunkBytes`, at least one row each.
ClientPort::Source imageRows(std::shared_ptr<const KeptImage> image, std::size_t chunkBytes);

/// What a client may ask for; 0 is our choice.
std::size_t chunkBytes(std::uint32_t asked);

}  // namespace emca
