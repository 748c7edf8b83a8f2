#pragma once

#include <condition_variable>
#include <list>
#include <memory>
#include <mutex>

#include "coordinator/blob_store.h"
#include "pipeline/pipeline.h"
#include "rpc/blob_client.h"
#include "rpc/messages.h"

namespace radfarm {

/// Prepared views by their inputs, opened once for all threads of a worker. Blobs come over the network by digest into
/// a folder that several workers of one machine may share, and are mapped from there. Thread-safe.
class PreparedCache {
 public:
  PreparedCache(const rpc::BlobClient& client, const BlobStore& store) : client_(client), store_(store) {}

  /// The view, which stays valid while the caller holds it. Waits when another thread is opening it. Shared: the cache
  /// keeps the last few, running tasks keep theirs. DATA_LOSS and NOT_FOUND mean that the job's blobs are gone.
  Result<std::shared_ptr<const Prepared>> get(const TaskInputs& inputs);

 private:
  struct Opened;
  struct Slot {
    TaskInputs inputs;
    bool ready = false;
    Result<std::shared_ptr<Opened>> opened = nullptr;
  };
  Result<MappedFile> fetch(const std::string& digest) const;
  Result<std::shared_ptr<Opened>> open(const TaskInputs& inputs) const;

  const rpc::BlobClient& client_;
  const BlobStore& store_;
  std::mutex mutex_;
  std::condition_variable ready_;
  std::list<std::shared_ptr<Slot>> slots_;  // latest used first
};

}  // namespace radfarm
