#include "emca/client/session.h"

#include <algorithm>

namespace emca::client {

Session sessionOf(const Dataset& dataset, const Selection& selection) {
    Session session;
    session.info = dataset.info();
    session.camera = dataset.camera();
    session.meshes = dataset.meshes();
    session.surface = dataset.surface();
    session.images = dataset.images();
    for (ImageEntry& entry : session.images) {
        if (entry.preview && entry.image) entry.image = std::make_shared<const RenderedImage>(*entry.image);
    }
    session.currentImage = dataset.currentImageIndex();
    session.traces = dataset.traces();
    for (const auto& trace : dataset.current()) {
        auto found = std::find(session.traces.begin(), session.traces.end(), trace);
        if (found == session.traces.end()) found = session.traces.insert(found, trace);  // shown, but gone from the history
        session.shown.push_back(static_cast<std::size_t>(found - session.traces.begin()));
    }
    session.selection = selection.state();
    return session;
}

void show(const Session& session, Dataset& dataset, Selection& selection) {
    std::vector<std::shared_ptr<const Trace>> shown;
    for (const std::size_t index : session.shown) {
        if (index < session.traces.size()) shown.push_back(session.traces[index]);
    }
    {
        const Dataset::Transaction once(dataset);
        dataset.setInfo(session.info);
        dataset.setCamera(session.camera);
        dataset.setMeshes(session.meshes);
        dataset.setSurface(session.surface);
        dataset.setImages(session.images, session.currentImage);
        dataset.setTraces(session.traces);
        dataset.setCurrent(std::move(shown));
    }
    // A view that hears of the selection already has the data that it names.
    selection.set(session.selection);
}

}  // namespace emca::client
