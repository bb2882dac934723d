#include "window/edit_history.h"

#include <QScopedValueRollback>
#include <algorithm>
#include <cctype>
#include <utility>

#include "paths/filter_panel.h"

namespace emca::explorer {
namespace {

/// A field of the filter in which a text changed, and how.
struct TextChange {
    std::size_t field = 0;          ///< 0: the query; then quantity and value of each rule
    const std::string *before = nullptr, *after = nullptr;
};

/// Nothing if more than one text of a person's changed, or something else. The query follows from the rules.
std::optional<TextChange> textChange(const client::SavedFilter& a, const client::SavedFilter& b) {
    if (a.automatic != b.automatic || a.rules.size() != b.rules.size()) return std::nullopt;
    std::optional<TextChange> change;
    for (std::size_t i = 0; i < a.rules.size(); ++i) {
        const client::SavedFilter::Rule &p = a.rules[i], &q = b.rules[i];
        if (p == q) continue;
        const bool quantity = p.quantity != q.quantity;
        if (change || (quantity && p.value != q.value) || (!quantity && (p.over != q.over || p.operation != q.operation))) return std::nullopt;
        change = quantity ? TextChange{1 + 2 * i, &p.quantity, &q.quantity} : TextChange{2 + 2 * i, &p.value, &q.value};
    }
    if (!change && a.query != b.query) change = TextChange{0, &a.query, &b.query};
    return change;
}

/// One character came or went, and it begins no word.
bool goesOn(const std::string& before, const std::string& after) {
    constexpr std::size_t kCharacter = 4;   // bytes of one in UTF-8 at most
    const std::size_t common = static_cast<std::size_t>(std::ranges::mismatch(before, after).in1 - before.begin());
    if (after.size() < before.size()) return before.size() - after.size() <= kCharacter;
    if (after.size() - before.size() > kCharacter) return false;
    const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    return common == 0 || common == after.size() || !blank(after[common - 1]) || blank(after[common]);
}

/// Only paths of pixels that are no longer looked at went.
bool isConsequence(const client::Selection::State& a, const client::Selection::State& b) {
    if (a.pixel != b.pixel || a.region != b.region || b.paths.size() >= a.paths.size()) return false;
    const auto looked = [&](Pixel pixel) { return b.pixel == pixel || b.region.contains(pixel); };
    return std::ranges::includes(a.paths, b.paths) &&
           std::ranges::all_of(a.paths, [&](const client::PathId& id) { return !looked(id.pixel) || std::ranges::binary_search(b.paths, id); });
}

}  // namespace

EditHistory::EditHistory(client::Selection& selection, FilterPanel& filter, QObject* parent)
    : QObject(parent), selection_(selection), filter_(filter), last_(now()), listening_(selection, [this](std::uint32_t parts) {
          if ((parts & ~static_cast<std::uint32_t>(client::SelectionPart::hover)) != 0) record();
      }) {
    connect(&filter_, &FilterPanel::edited, this, &EditHistory::record);
}

EditHistory::State EditHistory::now() const { return {selection_.state(), filter_.state()}; }

void EditHistory::record() {
    if (restoring_) return;
    State next = now();
    if (next == last_) return;
    const auto text = next.selection == last_.selection ? textChange(last_.filter, next.filter) : std::nullopt;
    const bool goesOnHere = text && typing_ == text->field && goesOn(*text->before, *text->after);
    typing_ = text ? std::optional(text->field) : std::nullopt;
    if (goesOnHere || (next.filter == last_.filter && isConsequence(last_.selection, next.selection))) {
        last_ = std::move(next);
        return;
    }
    undone_.clear();
    done_.push_back(std::exchange(last_, std::move(next)));
    forgetOldest();
    emit changed();
}

void EditHistory::forgetOldest() {
    std::size_t paths = 0, kept = 0;
    while (kept < std::min(done_.size(), kSteps)) {
        paths += done_[done_.size() - 1 - kept].selection.paths.size();
        if (kept > 0 && paths > kPaths) break;
        ++kept;
    }
    done_.erase(done_.begin(), done_.end() - static_cast<std::ptrdiff_t>(kept));
}

void EditHistory::move(std::vector<State>& from, std::vector<State>& to) {
    if (from.empty()) return;
    const State wanted = std::move(from.back());
    from.pop_back();
    to.push_back(now());
    {
        const QScopedValueRollback<bool> guard(restoring_, true);
        filter_.setState(wanted.filter);
        selection_.set(wanted.selection);
        // Another pixel came, and what is applied by itself selected its own.
        if (selection_.state() != wanted.selection) selection_.set(wanted.selection);
    }
    last_ = now();
    typing_.reset();
    emit changed();
}

void EditHistory::clear() {
    done_.clear();
    undone_.clear();
    last_ = now();
    typing_.reset();
    emit changed();
}

}  // namespace emca::explorer
