#pragma once

#include <QFont>
#include <QString>

namespace emca::explorer {

/// Registers a variant of a font whose digits have equal width, and returns the variant's family name; the font's own
/// family if its digits have equal width already; an empty string if the font has no such digits.
///
/// Fonts like Inter keep them behind the OpenType feature "tnum", which Qt can switch on only from 6.7. The variant is
/// the same font in memory whose character map leads to those glyphs. Source: OpenType 1.9, tables cmap, name, GSUB.
/// GUI thread; call it once per family and weight.
QString tabularFamily(const QFont& font);

/// Whether the digits 0 to 9 are equally wide.
bool hasTabularDigits(const QFont& font);

}  // namespace emca::explorer
