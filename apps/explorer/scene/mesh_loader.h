#pragma once

#include <QColor>
#include <QObject>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "mesh_layer.h"

namespace emca::explorer {

/// Prepares the meshes of large scenes beside the GUI thread; small ones at once.
class MeshLoader : public QObject {
    Q_OBJECT
  public:
    using Meshes = std::shared_ptr<const std::vector<Mesh>>;
    explicit MeshLoader(QObject* parent = nullptr);
    ~MeshLoader() override;

    /// Gives up what is under way. `ready` follows, from within this call for small scenes.
    void load(Meshes meshes, const QColor& clay, bool ownColors);
    bool isLoading() const { return loading_; }

  signals:
    void ready(std::shared_ptr<emca::explorer::PreparedMeshes> meshes);

  private:
    void cancel();
    std::thread worker_;
    std::shared_ptr<std::atomic<bool>> cancelled_;
    bool loading_ = false;
};

}  // namespace emca::explorer
