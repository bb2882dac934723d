// Sessions: files that hold what was received, and what a person made of it.
#include "emca/client/session.h"

#include "arrays.h"
#include "bindings.h"
#include "scene.h"
#include "waiting.h"

namespace emca::python {
namespace {

using client::ImageEntry;
using client::PathId;
using client::RequestObserver;
using client::Session;
using client::Trace;

py::tuple toTuple(const PathId& path) { return py::make_tuple(path.pixel.x, path.pixel.y, path.sample, path.part); }

PathId toPathId(py::handle path) {
    const auto parts = py::reinterpret_borrow<py::sequence>(path);
    return {{parts[0].cast<std::uint32_t>(), parts[1].cast<std::uint32_t>()},
            parts[2].cast<std::int64_t>(),
            parts[3].cast<std::int32_t>()};
}

py::object orNone(bool there, const std::function<py::object()>& make) {
    return there ? make() : py::object(py::none());
}

/// By the names of emca.Session.
py::dict sessionDict(const Session& session) {
    py::dict out;
    out["info"] = orNone(session.info.has_value(), [&] { return py::cast(*session.info); });
    out["camera"] = orNone(session.camera.has_value(), [&] { return toDict(*session.camera); });
    out["meshes"] = orNone(session.meshes != nullptr, [&] { return toList(session.meshes); });
    out["surface"] = orNone(session.surface != nullptr, [&] { return py::cast(SharedField{session.surface}); });
    py::list images, traces, selected, pixelNotes;
    for (const ImageEntry& image : session.images) images.append(std::make_shared<ImageEntry>(image));
    for (const auto& trace : session.traces)
        traces.append(std::const_pointer_cast<Trace>(trace));  // nobody here changes it
    for (const PathId& path : session.selection.paths) selected.append(toTuple(path));
    for (const client::PixelNote& note : session.pixelNotes)
        pixelNotes.append(py::make_tuple(note.pixel.x, note.pixel.y, toText(note.text)));
    out["images"] = images;
    out["current_image"] = session.currentImage;
    out["traces"] = traces;
    py::list shown;
    for (const std::size_t index : session.shown) shown.append(index);
    out["shown"] = shown;
    out["selected_paths"] = selected;
    out["notes"] = toText(session.notes);
    out["pixel_notes"] = pixelNotes;
    return out;
}

/// \return (session, whole, notices, software, saved)
py::tuple open(const std::string& file) {
    const client::OpenedSession opened =
        await([&](const RequestObserver& observer) { return client::openSession(file, {}, observer); });
    return py::make_tuple(sessionDict(opened.session), opened.whole, toList(opened.notices), toText(opened.software),
                          opened.saved);
}

Session toSession(const py::dict& given) {
    Session session;
    if (const py::object info = given["info"]; !info.is_none()) session.info = info.cast<client::ServerInfo>();
    if (const py::object camera = given["camera"]; !camera.is_none()) session.camera = toCamera(camera);
    if (const py::object meshes = given["meshes"]; !meshes.is_none())
        session.meshes = std::make_shared<const std::vector<Mesh>>(toMeshes(meshes));
    if (const py::object surface = given["surface"]; !surface.is_none())
        session.surface = surface.cast<SharedField&>().field;
    for (const py::handle image : given["images"]) session.images.push_back(image.cast<const ImageEntry&>());
    session.currentImage = given["current_image"].cast<std::size_t>();
    for (const py::handle trace : given["traces"]) session.traces.push_back(trace.cast<std::shared_ptr<Trace>>());
    for (const py::handle index : given["shown"]) session.shown.push_back(index.cast<std::size_t>());
    for (const py::handle path : given["selected_paths"]) session.selection.paths.push_back(toPathId(path));
    session.notes = given["notes"].cast<std::string>();
    for (const py::handle item : given["pixel_notes"]) {
        const auto note = py::reinterpret_borrow<py::tuple>(item);
        session.pixelNotes.push_back(
            {{note[0].cast<std::uint32_t>(), note[1].cast<std::uint32_t>()}, note[2].cast<std::string>()});
    }
    return session;
}

void save(const std::string& file, const py::dict& given, const py::object& progress) {
    const Session session = toSession(given);
    await([&](const RequestObserver& observer) { return client::saveSession(file, session, observer); }, progress);
}

}  // namespace

void bindSession(py::module_& module) {
    module.def("open_session", &open);
    module.def("save_session", &save);
    module.def("is_session", [](const std::string& file) { return client::isSession(file); });
}

}  // namespace emca::python
