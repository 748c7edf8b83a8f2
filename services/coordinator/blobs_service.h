#pragma once

#include "coordinator/blob_store.h"
#include "radfarm/v1/blobs.grpc.pb.h"

namespace radfarm {

/// v1.Blobs over a BlobStore. Workers only read.
class BlobsService final : public v1::Blobs::CallbackService {
 public:
  enum class Access { kReadOnly, kReadWrite };
  BlobsService(const BlobStore& blobs, Access access) : blobs_(blobs), access_(access) {}

  grpc::ServerUnaryReactor* FindMissingBlobs(grpc::CallbackServerContext* context,
                                             const v1::FindMissingBlobsRequest* request,
                                             v1::FindMissingBlobsResponse* response) override;
  grpc::ServerReadReactor<v1::UploadBlobRequest>* UploadBlob(grpc::CallbackServerContext* context,
                                                             v1::UploadBlobResponse* response) override;
  grpc::ServerWriteReactor<v1::DownloadBlobResponse>* DownloadBlob(grpc::CallbackServerContext* context,
                                                                   const v1::DownloadBlobRequest* request) override;

 private:
  const BlobStore& blobs_;
  Access access_;
};

}  // namespace radfarm
