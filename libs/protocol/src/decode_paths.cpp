#include "decoder.h"

namespace emca::protocol {

namespace {

Column decodeColumn(Decoder& d, const wire::Column& source) {
    Column column;
    column.name = d.text(source.name());
    column.scope = d.enumeration(source.scope(), Scope::vertex, "scope");
    column.type = d.enumeration(source.type(), ValueType::spectrum, "value type");
    column.count = source.count();
    column.owners = d.view<Index>(source.owners());
    column.bytes = d.view<std::byte>(source.bytes());
    column.spectrumOffsets = d.view<std::uint32_t>(source.spectrum_offsets());
    column.locations = d.view<std::uint32_t>(source.locations());
    return column;
}

}  // namespace

PathSet decodePaths(Decoder& d, const wire::Paths* source) {
    if (!source) return {};
    PathColumns c;
    c.pixels = d.view<Pixel>(source->pixels());
    c.samples = d.view<std::int64_t>(source->samples());
    c.parts = d.view<std::int32_t>(source->parts());
    c.pathFlags = d.view<std::uint8_t>(source->path_flags());
    c.origins = d.view<Vec3f>(source->origins());
    c.estimates = d.view<Color>(source->estimates());
    c.firstVertex = d.view<Index>(source->first_vertex());
    c.depths = d.view<std::int32_t>(source->depths());
    c.vertexFlags = d.view<std::uint8_t>(source->vertex_flags());
    c.positions = d.view<Vec3f>(source->positions());
    c.vertexEstimates = d.view<Color>(source->vertex_estimates());
    c.emissions = d.view<Color>(source->emissions());
    c.meshes = d.view<std::int32_t>(source->meshes());
    c.faces = d.view<std::int32_t>(source->faces());
    c.events = d.view<std::uint8_t>(source->events());
    c.lobes = d.view<std::uint8_t>(source->lobes());
    c.labels = d.view<std::uint32_t>(source->labels());
    c.nextEventOwners = d.view<Index>(source->next_event_owners());
    c.nextEvents = d.view<NextEvent>(source->next_events());
    c.contributionOwners = d.view<Index>(source->contribution_owners());
    c.contributions = d.view<Contribution>(source->contributions());
    c.splatOwners = d.view<Index>(source->splat_owners());
    c.splats = d.view<Splat>(source->splats());
    if (source->columns()) {
        c.columns.reserve(source->columns()->size());
        for (const wire::Column* column : *source->columns()) c.columns.push_back(decodeColumn(d, *column));
    }
    c.strings = d.texts(source->strings());
    if (d.failed()) return {};
    auto paths = PathSet::make(std::move(c));
    if (!paths) {
        d.fail(paths.error().message);
        return {};
    }
    return std::move(paths).value();
}

}  // namespace emca::protocol
