#pragma once
#include <unistd.h>

#include <filesystem>
#include <string>

#include "parallel/communicator.hpp"

namespace pliant {

/// An empty folder of its own for all ranks of a test; it goes with its owner. Collective at both ends.
class SharedFolder {
 public:
  SharedFolder() {
    std::string name;
    if (ranks_.is_root()) {
      name = (std::filesystem::temp_directory_path() / "pliant-mpi-XXXXXX").string();
      if (mkdtemp(name.data()) == nullptr) name.clear();
    }
    path_ = ranks_.broadcast(name);
    if (path_.empty()) throw std::runtime_error("no temporary folder can be made");
  }
  ~SharedFolder() {
    MPI_Barrier(ranks_.handle());
    std::error_code ignored;
    if (ranks_.is_root()) std::filesystem::remove_all(path_, ignored);
  }
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  Communicator ranks_;
  std::filesystem::path path_;
};

}  // namespace pliant
