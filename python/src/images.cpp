// Images as numpy arrays.
#include "images.h"

#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"

namespace emca::python {
namespace {

using client::ImageEntry;

std::vector<std::string> usualChannels(std::size_t count) {
    if (count == 1) return {"Y"};
    if (count == 3) return {"R", "G", "B"};
    if (count == 4) return {"R", "G", "B", "A"};
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) names.push_back(std::to_string(i));
    return names;
}

const Image& chosen(const ImageEntry& entry, const std::string& which) {
    if (which == "color") return entry.image->color;
    if (which == "samples") return entry.image->samples;
    if (which == "variance") return entry.image->variance;
    throw py::key_error(which);
}

py::dict settingsOf(const ImageEntry& entry) {
    py::dict out;
    out["title"] = toText(entry.title);
    out["render_id"] = entry.renderId;
    out["samples_per_pixel"] = entry.samplesPerPixel;
    out["seed"] = entry.seed;
    out["integrator"] = toText(entry.integrator);
    out["sampler"] = toText(entry.sampler);
    return out;
}

std::shared_ptr<ImageEntry> makeImage(py::handle array, std::vector<std::string> channels, std::string title) {
    auto entry = std::make_shared<ImageEntry>();
    entry->title = std::move(title);
    entry->image = std::make_shared<const RenderedImage>(
        RenderedImage{.color = toImage(array, std::move(channels)), .samples = {}, .variance = {}});
    return entry;
}

}  // namespace

Image toImage(py::handle array, std::vector<std::string> channels) {
    const Numbers numbers = toFloats(array);
    const auto& shape = numbers.shape;
    if (shape.size() != 2 && shape.size() != 3)
        throw py::value_error("an image must have the shape (height, width) or (height, width, channels)");
    const std::size_t count = shape.size() == 3 ? shape[2] : 1;
    if (shape[0] > 0xffffffffu || shape[1] > 0xffffffffu) throw py::value_error("an image cannot be so large");
    if (channels.empty()) channels = usualChannels(count);
    if (channels.size() != count) throw py::value_error("an image needs one name per channel");
    Image image(static_cast<std::uint32_t>(shape[1]), static_cast<std::uint32_t>(shape[0]), std::move(channels));
    std::copy(numbers.values.begin(), numbers.values.end(), image.data());
    return image;
}

py::object toArray(const Image& image, std::shared_ptr<const void> owner) {
    if (image.empty()) return py::none();
    return imageView(image.data(), image.height(), image.width(), image.channelCount(), std::move(owner));
}

void bindImages(py::module_& module) {
    py::class_<ImageEntry, std::shared_ptr<ImageEntry>>(module, "Image")
        .def("settings", &settingsOf)
        .def("array", [](const ImageEntry& entry,
                         const std::string& which) { return toArray(chosen(entry, which), entry.image); })
        .def("channels", [](const ImageEntry& entry) { return toList(entry.image->color.channels()); })
        .def("set_title", [](ImageEntry& entry, std::string title) { entry.title = std::move(title); });
    module.def("make_image", &makeImage);
}

}  // namespace emca::python
