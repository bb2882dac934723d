#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "json.h"

// A page of `emca export`: one HTML file with everything inside, made of apps/cli/html/ and data.
namespace emca::cli {

/// The page that shows `data` (html_data.h). It loads nothing, and may not: its content security policy allows its own
/// script and style, by their SHA-256, and no connection. Nothing in title or data can end the elements that hold them.
std::string htmlPage(const std::string& title, const Json& data);

/// Text as it stands in HTML, between tags or in quotes; control characters become U+FFFD.
std::string escapeHtml(std::string_view text);

/// JSON as it stands in a script element: without line feeds and without '<', which only texts contain.
std::string scriptJson(const Json& data);

/// RFC 4648, section 4, with padding.
std::string toBase64(std::span<const std::byte> bytes);

}  // namespace emca::cli
