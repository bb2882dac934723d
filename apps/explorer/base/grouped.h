#pragma once

#include <QLocale>
#include <QString>
#include <cstdint>

namespace emca::explorer {

/// A count for people, whatever the system's language: "65,536".
inline QString grouped(std::uint64_t count) { return QLocale(QLocale::English).toString(qulonglong(count)); }

}  // namespace emca::explorer
