#include "config/case_document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "config/flatten.hpp"
#include "config/named_scopes.hpp"
#include "config/overrides.hpp"
#include "core/error.hpp"

namespace pliant {
namespace {
std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw InputError(fmt::format("{}: cannot be opened ({}); give a case file or a folder with a case.toml",
                                 file.string(), std::strerror(errno)));
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw InputError(fmt::format("{}: cannot be read", file.string()));
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw InputError(fmt::format("{}: is empty; docs/case-reference.md lists the keys of a case", file.string()));
  return text;
}

toml::table parse(const std::filesystem::path& file) {
  const auto text = read_text(file);
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", file.string(), error.source().begin.line,
                                 std::string(error.description())));
  }
}

void read_bodies(const toml::table& table, const OriginOf& origin_of, CaseDocument& document) {
  const auto* node = table.get("body");
  if (!node) return;
  const auto* array = node->as_array();
  if (!array) {
    document.problems.push_back(fmt::format("{}: body must be a list of tables; write [[body]]", origin_of(*node)));
    return;
  }
  const auto known = KnownPaths::of_body();
  for (const auto& element : *array) {
    const auto* body = element.as_table();
    if (!body) {
      document.problems.push_back(fmt::format("{}: each body must be a table; write [[body]]", origin_of(element)));
      continue;
    }
    Scope scope;
    const auto name = (*body)["name"].value<std::string>();
    scope.prefix = name ? fmt::format("body.{}.", *name) : fmt::format("body[{}].", document.bodies.size());
    scope.origin = origin_of(element);
    flatten(*body, known, origin_of, scope, document.problems);
    auto parts = read_parts(*body, scope.prefix, origin_of, document.problems);
    document.parts.insert(document.parts.end(), parts.begin(), parts.end());
    document.bodies.push_back(std::move(scope));
  }
}
}  // namespace

const Entry* Scope::find(const std::string& path) const {
  for (const auto& entry : entries) {
    if (entry.path == path) return &entry;
  }
  return nullptr;
}

CaseDocument read_document(const std::filesystem::path& file, std::span<const std::string> overrides) {
  const auto table = parse(file);
  CaseDocument document;
  document.file = file;
  const OriginOf origin_of = [&](const toml::node& node) {
    return fmt::format("{}:{}", file.string(), node.source().begin.line);
  };
  flatten(table, KnownPaths::of_case(), origin_of, document.root, document.problems);
  document.signals = read_signals(table, origin_of, document.problems);
  document.cavities = read_cavities(table, origin_of, document.problems);
  document.patches = read_patches(table, origin_of, document.problems).patches;
  read_bodies(table, origin_of, document);
  for (const auto& text : overrides) apply_override(text, document);
  return document;
}

}  // namespace pliant
