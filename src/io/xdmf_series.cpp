#include "io/xdmf_series.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "io/atomic_file.hpp"

namespace pliant {

XdmfSeries::XdmfSeries(std::filesystem::path path, std::string name) : path_(std::move(path)), name_(std::move(name)) {}

void XdmfSeries::add(double time, std::string body) {
  snapshots_.push_back({time, std::move(body)});
  write();
}

void XdmfSeries::resume(std::size_t count) {
  std::ostringstream all;
  if (count > 0) all << std::ifstream(path_).rdbuf();
  const auto text = all.str();
  // As `write` writes it: time, contents, end.
  const std::string before = "<Time Value=\"", after = "\"/>\n", end = "</Grid>\n";
  snapshots_.clear();
  std::size_t at = 0;
  while (snapshots_.size() < count) {
    const auto time = text.find(before, at), body = text.find(after, time), stop = text.find(end, body);
    if (stop == std::string::npos)
      throw RunError(
          fmt::format("{} lists {} snapshots, but listed {} before", path_.string(), snapshots_.size(), count));
    const auto begin = time + before.size();
    snapshots_.push_back(
        {std::stod(text.substr(begin, body - begin)), text.substr(body + after.size(), stop - body - after.size())});
    at = stop;
  }
  if (count > 0) write();
  else remove_quietly(path_);
}

void XdmfSeries::write() const {
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
      "<Xdmf Version=\"2.0\">\n<Domain>\n<Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
      escape_xml(name_));
  for (const auto& snapshot : snapshots_)
    text += fmt::format("<Grid Name=\"{}\" GridType=\"Uniform\">\n<Time Value=\"{}\"/>\n{}</Grid>\n", escape_xml(name_),
                        snapshot.time, snapshot.body);
  text += "</Grid>\n</Domain>\n</Xdmf>\n";
  write_file_atomically(path_, text);
}

std::string escape_xml(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

std::string xdmf_item(const std::string& dimensions, const char* type, int bytes, const std::string& place) {
  return fmt::format("<DataItem Format=\"HDF\" Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\">{}</DataItem>\n",
                     dimensions, type, bytes, escape_xml(place));
}

}  // namespace pliant
