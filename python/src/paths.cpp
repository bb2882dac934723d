// Paths as numpy arrays: views on the columns as they were received.
#include "emca/core/path_set.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "arrays.h"
#include "bindings.h"
#include "errors.h"
#include "unlocked.h"

namespace emca::python {
namespace {

using Getter = py::object (*)(const PathColumns&);

/// Of a part of a struct in a column.
template <auto Member>
using Entry = std::remove_cvref_t<decltype((std::declval<PathColumns>().*Member)[0])>;

template <auto Member, Number number, std::size_t components = 1, std::size_t offset = 0>
py::object part(const PathColumns& columns) {
    return view(columns.*Member, number, components, offset);
}

/// Names of arrays, as emca/_native.pyi lists them.
const std::map<std::string_view, Getter>& arrays() {
    using C = PathColumns;
    static const std::map<std::string_view, Getter> table{
        {"pixel", part<&C::pixels, Number::uint32, 2>},
        {"sample", part<&C::samples, Number::int64>},
        {"part", part<&C::parts, Number::int32>},
        {"path_flags", part<&C::pathFlags, Number::uint8>},
        {"origin", part<&C::origins, Number::float32, 3>},
        {"estimate", part<&C::estimates, Number::float32, 3>},
        {"first_vertex", part<&C::firstVertex, Number::uint32>},
        {"depth", part<&C::depths, Number::int32>},
        {"vertex_flags", part<&C::vertexFlags, Number::uint8>},
        {"position", part<&C::positions, Number::float32, 3>},
        {"vertex_estimate", part<&C::vertexEstimates, Number::float32, 3>},
        {"emission", part<&C::emissions, Number::float32, 3>},
        {"mesh", part<&C::meshes, Number::int32>},
        {"face", part<&C::faces, Number::int32>},
        {"event", part<&C::events, Number::uint8>},
        {"lobe", part<&C::lobes, Number::uint8>},
        {"label", part<&C::labels, Number::uint32>},
        {"next_event_vertex", part<&C::nextEventOwners, Number::uint32>},
        {"next_event_position", part<&C::nextEvents, Number::float32, 3, offsetof(NextEvent, position)>},
        {"next_event_visible", part<&C::nextEvents, Number::uint32, 1, offsetof(NextEvent, visible)>},
        {"contribution_vertex", part<&C::contributionOwners, Number::uint32>},
        {"contribution_value", part<&C::contributions, Number::float32, 3, offsetof(Contribution, value)>},
        {"contribution_mis_weight", part<&C::contributions, Number::float32, 1, offsetof(Contribution, misWeight)>},
        {"contribution_technique", part<&C::contributions, Number::uint32, 1, offsetof(Contribution, technique)>},
        {"contribution_end", part<&C::contributions, Number::uint8, 1, offsetof(Contribution, end)>},
        {"splat_path", part<&C::splatOwners, Number::uint32>},
        {"splat_pixel", part<&C::splats, Number::uint32, 2, offsetof(Splat, pixel)>},
        {"splat_value", part<&C::splats, Number::float32, 3, offsetof(Splat, value)>},
    };
    return table;
}

py::object array(const PathSet& paths, const std::string& name) {
    const auto found = arrays().find(name);
    if (found == arrays().end()) throw py::key_error(name);
    return found->second(paths.columns());
}

Number numberOf(ValueType type) {
    switch (type) {
        case ValueType::boolean:
            return Number::boolean;
        case ValueType::integer:
        case ValueType::integer2:
        case ValueType::integer3:
            return Number::int64;
        case ValueType::double1:
        case ValueType::double2:
        case ValueType::double3:
            return Number::float64;
        case ValueType::text:
            return Number::uint32;
        default:
            return Number::float32;
    }
}

py::object valuesOf(const Column& column) {
    const Number number = numberOf(column.type);
    const auto components = static_cast<std::size_t>(std::max(1, componentCount(column.type)));
    const std::size_t stride = components * byteSize(number);
    return view(column.bytes.data(), number, column.bytes.size() / stride, components, stride, column.bytes.owner());
}

/// (scope, name, type, count, dense) of every user column.
py::list columnNames(const PathSet& paths) {
    py::list out;
    for (const Column& column : paths.userColumns())
        out.append(py::make_tuple(column.scope == Scope::vertex, toText(column.name), name(column.type), column.count,
                                  column.dense()));
    return out;
}

/// (values, owners or None, offsets of spectra or None, locations or None) of a user column.
py::tuple columnArrays(const PathSet& paths, std::size_t index) {
    if (index >= paths.userColumns().size()) throw py::index_error();
    const Column& column = paths.userColumns()[index];
    const auto orNone = [](bool there, const auto& values) {
        return there ? view(values, Number::uint32) : py::object(py::none());
    };
    return py::make_tuple(valuesOf(column), orNone(!column.dense(), column.owners),
                          orNone(column.type == ValueType::spectrum, column.spectrumOffsets),
                          orNone(!column.locations.empty(), column.locations));
}

/// NaN where a path has no estimate.
py::object luminances(const PathSet& paths) {
    std::vector<float> out(paths.pathCount(), std::numeric_limits<float>::quiet_NaN());
    for (Index path = 0; path < paths.pathCount(); ++path)
        if (const auto estimate = paths.estimate(path)) out[path] = luminance(*estimate);
    return moved(std::move(out), Number::float32);
}

py::object depths(const PathSet& paths) {
    std::vector<std::int32_t> out(paths.pathCount());
    for (Index path = 0; path < paths.pathCount(); ++path) out[path] = paths.depth(path);
    return moved(std::move(out), Number::int32);
}

std::shared_ptr<PathSet> subset(const PathSet& paths, py::handle positions) {
    const std::vector<std::uint32_t> chosen = toIndices(positions);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (chosen[i] >= paths.pathCount()) throw py::index_error("a path's position lies beyond the set");
        if (i > 0 && chosen[i] <= chosen[i - 1]) throw py::value_error("positions of paths must ascend");
    }
    const Unlocked unlocked;
    return std::make_shared<PathSet>(paths.subset(chosen));
}

std::shared_ptr<PathSet> merged(const py::iterable& sets) {
    std::vector<PathSet> all;
    for (const py::handle set : sets) all.push_back(set.cast<const PathSet&>());
    const Unlocked unlocked;
    return std::make_shared<PathSet>(PathSet::merged(all));
}

py::object findPath(const PathSet& paths, std::uint32_t x, std::uint32_t y, std::int64_t sample, std::int32_t number) {
    const auto found = paths.findPath({x, y}, sample, number);
    return found ? py::object(py::int_(*found)) : py::object(py::none());
}

}  // namespace

void bindPaths(py::module_& module) {
    py::class_<PathSet, std::shared_ptr<PathSet>>(module, "PathSet")
        .def(py::init<>())
        .def_property_readonly("path_count", &PathSet::pathCount)
        .def_property_readonly("vertex_count", &PathSet::vertexCount)
        .def("array", &array)
        .def("column_names", &columnNames)
        .def("column_arrays", &columnArrays)
        .def("strings", [](const PathSet& paths) { return toList(paths.columns().strings); })
        .def("luminance", &luminances)
        .def("path_depth", &depths)
        .def("subset", &subset)
        .def("find_path", &findPath);
    module.def("merged", &merged);

    py::list events, lobes;
    for (int i = 0; i < kEventCount; ++i) events.append(name(static_cast<Event>(i)));
    for (int i = 0; i < kLobeCount; ++i) lobes.append(name(static_cast<Lobe>(i)));
    module.attr("event_names") = py::tuple(events);
    module.attr("lobe_names") = py::tuple(lobes);
}

}  // namespace emca::python
