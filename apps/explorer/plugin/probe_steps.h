#pragma once

#include <QString>
#include <functional>

#include "emca/client/dataset.h"

namespace emca::explorer {

/// A pixel whose few paths have every kind of value that a renderer can record, among them NaN, infinity and empty text:
/// what a plugin is fed before anybody relies on it.
std::shared_ptr<const client::Trace> sampleTrace();

/// Loads a plugin, makes its widget and feeds it, in this process. Needs a GuardedApplication.
/// \param step  told what is done next
/// \return why it should not be loaded; empty: it behaved
QString tryPlugin(const QString& file, const std::function<void(const QString& step)>& step);

}  // namespace emca::explorer
