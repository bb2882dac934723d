#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "emca/core/result.h"
#include "emca/render/scene_node.h"
#include "emca/render/spectrum.h"
#include "xml_source.h"

namespace emca::render {

/// Property names as the 3.x dialect writes them: toWorld to_world, intIOR int_ior, toUV to_uv.
std::string toSnakeCase(std::string_view name);

/// Whether a tag is that of a property with its value in attributes (integer, rgb, point, …; not transform).
bool isValueTag(std::string_view tag);

/// The value of such an element. \param folder  where files named in it are
/// Errors: parseFailed; the message is the begin of a sentence: value "abc" of float "alpha" is not a finite number
Result<Property> readValue(const SceneElement& element, SpectrumUse use, const std::filesystem::path& folder);

/// Whether a tag is a step of a transform (translate, scale, rotate, lookat, matrix).
bool isTransformTag(std::string_view tag);

/// One step of a transform. Errors: as readValue.
Result<Transform> readTransformStep(const SceneElement& element);

/// The colour of a <spectrum type="…"> of the 3.x dialect whose nested properties are read already: uniform, regular,
/// irregular, blackbody, d65, rgb, srgb. Errors: as readValue; notSupported for other types.
Result<Color> evaluateSpectrum(const SceneNode& spectrum, SpectrumUse use);

}  // namespace emca::render
