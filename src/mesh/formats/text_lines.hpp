#pragma once
#include <charconv>
#include <functional>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace pliant {

/// Splits a line at blanks.
inline std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < line.size();) {
    const std::size_t begin = line.find_first_not_of(" \t\r\v\f", i);
    if (begin == std::string_view::npos) break;
    const std::size_t end = std::min(line.find_first_of(" \t\r\v\f", begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    i = end;
  }
  return words;
}

/// The whole word as a number; false if it is none or out of range.
template <class Number>
bool parse_number(std::string_view word, Number& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

/// Text for a message: at most 40 characters, what is not printable shown as '?'.
inline std::string printable(std::string_view text) {
  std::string result;
  for (char c : text.substr(0, 40)) result += (c >= ' ' && c <= '~') || c == '\t' ? c : '?';
  return text.size() > 40 ? result + "..." : result;
}

/// Gives the lines of a text that hold something, and their numbers from 1.
class LineReader {
 public:
  /// Lines whose first word begins with one of the characters of `comment_marks` are passed over.
  LineReader(std::istream& input, std::string comment_marks)
      : input_(input), comment_marks_(std::move(comment_marks)) {}

  bool next() {
    while (std::getline(input_, line_)) {
      ++number_;
      bytes_ += static_cast<long>(line_.size()) + 1;
      words_ = split_words(line_);
      if (words_.empty()) continue;
      if (comment_marks_.find(words_[0][0]) == std::string::npos) return true;
      if (on_comment_) on_comment_();
    }
    return false;
  }
  /// What to do with a comment, which is then in line() and words().
  void on_comment(std::function<void()> work) { on_comment_ = std::move(work); }
  long number() const { return number_; }
  /// The bytes of all lines so far, with their ends.
  long bytes() const { return bytes_; }
  const std::string& line() const { return line_; }
  const std::vector<std::string_view>& words() const { return words_; }

 private:
  std::istream& input_;
  std::function<void()> on_comment_;
  std::string comment_marks_, line_;
  std::vector<std::string_view> words_;
  long number_ = 0, bytes_ = 0;
};

}  // namespace pliant
