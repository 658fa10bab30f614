#pragma once
#include <iosfwd>
#include <memory>
#include <string>

#include "mesh/formats/ply_header.hpp"

namespace pliant {

/// Thrown by PlyData for an item that cannot be read, with the reason; the reader of the file collects them.
struct BadPlyItem {
  std::string what;
};

/// Walks through the data behind a PLY header, item by item and value by value, whatever its encoding.
class PlyData {
 public:
  virtual ~PlyData() = default;
  /// Steps to the next item; false at the end of the file.
  virtual bool next_item() = 0;
  /// The next value of the item, exactly (every type fits a double). Throws BadPlyItem.
  virtual double read(PlyType type) = 0;
  /// Passes over values of the item. Throws BadPlyItem.
  virtual void skip(PlyType type, long count) = 0;
  /// Throws BadPlyItem if the item holds more than was read.
  virtual void end_item() = 0;
  /// After a bad item: whether the next one can be found.
  virtual bool can_resume() const = 0;
  /// Where the current item is, for messages; `kind` and `number` name it where lines cannot.
  virtual std::string place(const std::string& kind, long number) const = 0;
  /// The line of the current item; 0 if the encoding has none.
  virtual long line() const = 0;
  /// Empty if the whole file is read, else a sentence on what is left, with its place.
  virtual std::string left_over() = 0;
};

/// The data that follows the lines read so far. All arguments must outlive the result.
std::unique_ptr<PlyData> open_ply_data(PlyEncoding encoding, LineReader& lines, std::istream& input,
                                       const std::string& source);

}  // namespace pliant
