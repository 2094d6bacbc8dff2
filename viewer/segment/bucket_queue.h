#pragma once

#include <vector>

namespace volumen {

/// A bucket queue of voxels over a window of costs. Voxels of equal cost come in no particular order.
class BucketQueue {
 public:
  /// Creates one empty bucket per cost.
  explicit BucketQueue(std::size_t buckets) : heads_(buckets, none) {}
  /// Adds a voxel (index >= 0).
  void push(std::size_t bucket, int voxel) {
    nodes_.push_back({heads_[bucket], voxel});
    heads_[bucket] = int(nodes_.size()) - 1;
  }
  /// Removes and returns the next voxel of a bucket; negative if the bucket is empty.
  int pop(std::size_t bucket) {
    const int node = heads_[bucket];
    if (node == none) return none;
    heads_[bucket] = nodes_[std::size_t(node)].next;
    return nodes_[std::size_t(node)].voxel;
  }
  /// Frees the nodes for reuse. All buckets must be empty.
  void clear() { nodes_.clear(); }

 private:
  static constexpr int none = -1;
  struct Node {
    int next, voxel;
  };
  std::vector<int> heads_;
  std::vector<Node> nodes_;
};

}  // namespace volumen
