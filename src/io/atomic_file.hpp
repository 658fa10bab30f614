#pragma once
#include <filesystem>
#include <string_view>

namespace pliant {

/// The temporary neighbour that a file is written to before it takes its name: "run.json.tmp" for "run.json".
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Replaces a file's contents in one piece: readers see the old text or the new one, never a part. Not collective.
/// Throws RunError with the file and the system's reason; then the old file stands and the temporary one is gone.
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

/// Gives a completely written temporary file its final name, replacing what was there.
/// Throws RunError with both names and the system's reason.
void rename_into_place(const std::filesystem::path& temporary, const std::filesystem::path& path);

/// Waits until a file, or the names in a folder, are on the disk. Throws RunError with the system's reason.
void bring_to_disk(const std::filesystem::path& path);

/// Removes a file that may or may not be there; failures are ignored. For cleaning up after another error.
void remove_quietly(const std::filesystem::path& path);

}  // namespace pliant
