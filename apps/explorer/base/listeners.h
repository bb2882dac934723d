#pragma once

#include <utility>

#include "emca/client/dataset.h"
#include "emca/client/selection.h"

namespace emca::explorer {

/// A registration with a Dataset or a Selection that ends with its owner. Every view holds one of each as its last
/// members, so that no call arrives while the view is being destroyed.
///
/// The convention of all views: a QWidget with the constructor
///     SomeView(client::Dataset&, client::Selection&, Theme&, QWidget* parent = nullptr);
/// which reads those models and nothing else, writes to the Selection alone, and restyles on Theme::themeChanged.
template <typename Model>
class Listening {
  public:
    Listening(Model& model, typename Model::Listener listener)
        : model_(model), id_(model.listen(std::move(listener))) {}
    ~Listening() { model_.unlisten(id_); }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;

  private:
    Model& model_;
    typename Model::ListenerId id_;
};

using DatasetListening = Listening<client::Dataset>;
using SelectionListening = Listening<client::Selection>;

}  // namespace emca::explorer
