#pragma once

#include <vector>

namespace volumen {

/// Voxels in order of what they cost, in one window of costs; of one cost in no order.
class BucketQueue {
 public:
  /// A bucket for each cost, all of them empty.
  explicit BucketQueue(std::size_t buckets) : heads_(buckets, none) {}
  /// A voxel more, >= 0.
  void push(std::size_t bucket, int voxel) {
    nodes_.push_back({heads_[bucket], voxel});
    heads_[bucket] = int(nodes_.size()) - 1;
  }
  /// Takes the next of a bucket; < 0 where there is none.
  int pop(std::size_t bucket) {
    const int node = heads_[bucket];
    if (node == none) return none;
    heads_[bucket] = nodes_[std::size_t(node)].next;
    return nodes_[std::size_t(node)].voxel;
  }
  /// Gives back the room of what was taken, once all was.
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
