#include "mesh_loader.h"

#include <QMetaObject>

namespace emca::explorer {
namespace {

constexpr std::size_t kAtOnce = 20000;   ///< triangles that are prepared faster than a frame is drawn

}  // namespace

MeshLoader::MeshLoader(QObject* parent) : QObject(parent) {}

MeshLoader::~MeshLoader() { cancel(); }

void MeshLoader::cancel() {
    if (cancelled_) *cancelled_ = true;
    if (worker_.joinable()) worker_.join();
    loading_ = false;
}

void MeshLoader::load(Meshes meshes, const QColor& clay, bool ownColors) {
    cancel();
    if (!meshes || meshes->empty()) {
        emit ready(nullptr);
        return;
    }
    std::size_t triangles = 0;
    for (const Mesh& mesh : *meshes) triangles += mesh.triangles.size();
    if (triangles <= kAtOnce) {
        emit ready(prepareMeshes(*meshes, clay, ownColors, nullptr));
        return;
    }
    loading_ = true;
    cancelled_ = std::make_shared<std::atomic<bool>>(false);
    worker_ = std::thread([this, meshes, clay, ownColors, cancelled = cancelled_] {
        auto prepared = prepareMeshes(*meshes, clay, ownColors, cancelled.get());
        if (*cancelled) return;
        // Runs in the GUI thread; the destructor joins this thread first, and Qt drops calls to what is gone.
        QMetaObject::invokeMethod(this, [this, cancelled, prepared] {
            if (*cancelled) return;
            loading_ = false;
            emit ready(prepared);
        }, Qt::QueuedConnection);
    });
}

}  // namespace emca::explorer
