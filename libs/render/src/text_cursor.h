#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace emca::render {

/// Walks over text with numbers, line by line; never beyond its end.
class TextCursor {
  public:
    explicit TextCursor(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

    bool atEnd() const { return at_ == end_; }
    std::size_t line() const { return line_; }  ///< from 1

    /// Passes blanks, not the end of the line. A backslash at the end of a line joins it with the next one.
    void skipBlanks() {
        while (at_ != end_) {
            if (*at_ == ' ' || *at_ == '\t' || *at_ == '\r') {
                ++at_;
            } else if (*at_ == '\\' && end_ - at_ > 1 && (at_[1] == '\n' || (at_[1] == '\r' && end_ - at_ > 2 && at_[2] == '\n'))) {
                at_ += at_[1] == '\n' ? 2 : 3;
                ++line_;
            } else {
                return;
            }
        }
    }

    /// Passes blanks and ends of lines.
    void skipSpace() {
        for (skipBlanks(); at_ != end_ && *at_ == '\n'; skipBlanks()) {
            ++at_;
            ++line_;
        }
    }

    void skipLine() {
        for (skipBlanks(); at_ != end_ && *at_ != '\n'; skipBlanks())
            ++at_;
        if (at_ != end_) {
            ++at_;
            ++line_;
        }
    }

    /// After blanks: nothing but the end of the line or a comment.
    bool atLineEnd() {
        skipBlanks();
        return at_ == end_ || *at_ == '\n' || *at_ == '#';
    }

    /// The next word up to a blank or the end of the line; empty at the end of the line.
    std::string_view word() {
        skipBlanks();
        const char* begin = at_;
        while (at_ != end_ && *at_ != ' ' && *at_ != '\t' && *at_ != '\r' && *at_ != '\n')
            ++at_;
        return {begin, static_cast<std::size_t>(at_ - begin)};
    }

    bool take(char c) {
        if (at_ == end_ || *at_ != c)
            return false;
        ++at_;
        return true;
    }

    /// A number right here, false if there is none. Numbers too large for a double become infinite, too small ones 0.
    bool number(double& value) {
        const char* begin = at_ != end_ && *at_ == '+' ? at_ + 1 : at_;
        const auto [end, error] = std::from_chars(begin, end_, value);
        if (error == std::errc::result_out_of_range)
            value = std::string_view(begin, static_cast<std::size_t>(end - begin)).find("e-") != std::string_view::npos
                        ? 0 : std::numeric_limits<double>::infinity();
        else if (error != std::errc())
            return false;
        at_ = end;
        return true;
    }

    bool integer(std::int64_t& value) {
        const auto [end, error] = std::from_chars(at_, end_, value);
        if (error != std::errc())
            return false;
        at_ = end;
        return true;
    }

    std::string_view rest() const { return {at_, static_cast<std::size_t>(end_ - at_)}; }

  private:
    const char* at_;
    const char* end_;
    std::size_t line_ = 1;
};

}  // namespace emca::render
