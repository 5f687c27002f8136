//! The broad phase of cloth against cloth: which features may come near one another in a step.
//!
//! Every node is given a box that it is expected to stay in. Features whose boxes meet are pairs;
//! as long as all nodes keep to their boxes, no others can touch, so that contacts before the step
//! and impacts after it are looked for among the same pairs. Nodes that leave their boxes get larger
//! ones, and their faces are looked up again. Where cloth is slow, boxes have room for the steps to
//! come: their pairs are kept as long as most nodes stay in them.

use glam::DVec3;
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhWorkspace};

use crate::collision::continuous::Features;
use crate::collision::topology::Topology;

/// Two features of the cloth without a common node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ClothPair {
    pub features: Features,
    /// Corners, three to a face: the node and the corners of the face, or the ends of one edge and
    /// of the other.
    pub corners: [u32; 4],
}

impl ClothPair {
    pub fn nodes(self, topology: &Topology) -> [usize; 4] {
        self.corners.map(|c| topology.triangles()[c as usize / 3][c as usize % 3] as usize)
    }

    /// A face of either feature.
    pub fn faces(self) -> [usize; 2] {
        [self.corners[0] as usize / 3, self.corners[3] as usize / 3]
    }

    /// What belongs to the first feature, and what to the second.
    pub fn split<T>(self, nodes: [T; 4]) -> (Vec<T>, Vec<T>) {
        let mut first = Vec::from(nodes);
        let second = first.split_off(point_count_of_first(self.features));
        (first, second)
    }
}

/// How many of the four points are the first feature's.
fn point_count_of_first(features: Features) -> usize {
    match features {
        Features::VertexFace => 1,
        Features::EdgeEdge => 2,
    }
}

/// Share of the nodes that may be fast, or out of their boxes, where pairs are kept: more have most
/// faces looked up again, one by one.
const OTHERS_SHARE_MAX: f64 = 0.125;

/// Steps as the one at hand that room must last for, or the pairs that it adds cost more than it saves.
const STEPS_MIN: f64 = 3.0;

/// The pairs of a step.
pub struct ClothPairs {
    /// Of faces, in their boxes.
    tree: Bvh,
    workspace: BvhWorkspace,
    boxes: Boxes,
    /// Mean position where the boxes were made (m).
    centre: DVec3,
    /// How far boxes have moved along when the step ends (m).
    drift: DVec3,
    found: Vec<ClothPair>,
    /// How much farther boxes reach than the step that they were made for asks (m).
    room: f64,
}

/// Boxes around the ways of nodes, and of edges and faces around their nodes'.
struct Boxes {
    node: Vec<Aabb>,
    edge: Vec<Aabb>,
    face: Vec<Aabb>,
}

impl ClothPairs {
    pub fn new(positions: &[DVec3], topology: &Topology) -> Self {
        let boxes = Boxes::new(positions.iter().map(|&x| Aabb::new(x, x)).collect(), topology);
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes.face);
        let (workspace, centre, drift) = (BvhWorkspace::default(), DVec3::ZERO, DVec3::ZERO);
        Self { tree, workspace, boxes, centre, drift, found: Vec::new(), room: 0.0 }
    }

    /// Finds the pairs for a step from `start`, on which nodes are expected to go `way` (m): boxes
    /// reach farther than both ends by `reach` (m). All features nearer to one another than twice the
    /// reach are among them.
    ///
    /// Boxes move along with the mean way: what all have in common brings nothing together.
    pub fn find(
        &mut self,
        topology: &Topology,
        start: &[DVec3],
        way: impl Fn(usize) -> DVec3,
        reach: f64,
    ) {
        self.find_with_room(topology, start, &way, reach, 0.0);
    }

    /// As [`find`](Self::find), but where the cloth is slow boxes have `room` (m) beyond the reach, and
    /// what has been found holds for all steps that keep to it.
    pub fn find_or_keep(
        &mut self,
        topology: &Topology,
        start: &[DVec3],
        way: impl Fn(usize) -> DVec3,
        reach: f64,
        room: f64,
    ) {
        if self.room > 0.0 && self.keep(topology, start, &way, reach) {
            return;
        }
        let mean = mean(start.len(), &way);
        let is_fast = |&n: &usize| STEPS_MIN * (way(n) - mean).length() > room;
        let room =
            if are_few((0..start.len()).filter(is_fast).count(), start) { room } else { 0.0 };
        self.find_with_room(topology, start, &way, reach, room);
    }

    /// Has the next step look everything up again.
    pub fn keep_no_longer(&mut self) {
        self.room = 0.0;
    }

    fn find_with_room(
        &mut self,
        topology: &Topology,
        start: &[DVec3],
        way: &impl Fn(usize) -> DVec3,
        reach: f64,
        room: f64,
    ) {
        self.room = room;
        self.centre = mean(start.len(), |n| start[n]);
        self.drift = mean(start.len(), way);
        for (node, (&x, own)) in start.iter().zip(&mut self.boxes.node).enumerate() {
            *own = around([x, x + (way(node) - self.drift)]).loosened(reach + room);
        }
        self.boxes.fit(topology);
        for (index, of_face) in self.boxes.face.iter().enumerate() {
            self.tree.insert_or_update_partially(*of_face, index as u32, 0.0);
        }
        self.tree.refit_without_opt();
        self.found.clear();
        let (boxes, found) = (&self.boxes, &mut self.found);
        let mut push = |a: u32, b: u32| boxes.push_pairs(topology, [a, b], found);
        self.tree.traverse_bvtt_single_tree::<false>(&mut self.workspace, &mut push);
    }

    /// Makes the pairs hold for another step, if that takes larger boxes for few nodes only; `false`,
    /// and nothing is done, if not.
    fn keep(
        &mut self,
        topology: &Topology,
        start: &[DVec3],
        way: &impl Fn(usize) -> DVec3,
        reach: f64,
    ) -> bool {
        let so_far = mean(start.len(), |n| start[n]) - self.centre;
        let drift = so_far + mean(start.len(), way);
        let asked = |node: usize| {
            let ends = [start[node] - so_far, start[node] + way(node) - drift];
            around(ends).loosened(reach)
        };
        let out: Vec<usize> =
            (0..start.len()).filter(|&n| !self.boxes.node[n].contains(&asked(n))).collect();
        if !are_few(out.len(), start) {
            return false;
        }
        self.drift = drift;
        for &node in &out {
            self.boxes.node[node].merge(&asked(node).loosened(self.room));
        }
        self.add_pairs_of(topology, &out);
        true
    }

    /// Sees to it that the pairs hold for nodes that end where they do: those that left their
    /// boxes get boxes that reach farther by `reach` (m), and pairs are added.
    pub fn cover(&mut self, topology: &Topology, ends: &[DVec3], reach: f64) {
        let mut out = Vec::new();
        for (node, (x, own)) in ends.iter().zip(&mut self.boxes.node).enumerate() {
            let end = *x - self.drift;
            if end.clamp(own.mins, own.maxs) != end {
                out.push(node);
                own.merge(&Aabb::new(end, end).loosened(reach));
            }
        }
        self.add_pairs_of(topology, &out);
    }

    /// Adds the pairs that come of some nodes' larger boxes.
    fn add_pairs_of(&mut self, topology: &Topology, nodes: &[usize]) {
        if nodes.is_empty() {
            return;
        }
        let mut is_out = vec![false; self.boxes.node.len()];
        nodes.iter().for_each(|&n| is_out[n] = true);
        self.boxes.fit(topology);
        let is_larger =
            |f: u32| topology.triangles()[f as usize].iter().any(|&n| is_out[n as usize]);
        let larger: Vec<u32> =
            (0..topology.triangles().len() as u32).filter(|&f| is_larger(f)).collect();
        for &face in &larger {
            self.tree.insert_or_update_partially(self.boxes.face[face as usize], face, 0.0);
        }
        self.tree.refit_without_opt();
        for &face in &larger {
            for other in self.tree.intersect_aabb(&self.boxes.face[face as usize]) {
                if other != face && (!is_larger(other) || face < other) {
                    self.boxes.push_pairs(topology, [face, other], &mut self.found);
                }
            }
        }
        self.found.sort_unstable();
        self.found.dedup();
    }

    /// Drops the pairs that have tangled nodes on both sides.
    pub fn leave_out(&mut self, topology: &Topology, tangled: &[bool]) {
        let is_tangled = |nodes: &[usize]| nodes.iter().any(|&n| tangled[n]);
        self.found.retain(|pair| {
            let nodes = pair.nodes(topology);
            let (one, other) = nodes.split_at(point_count_of_first(pair.features));
            !(is_tangled(one) && is_tangled(other))
        });
    }

    pub fn found(&self) -> &[ClothPair] {
        &self.found
    }
}

impl Boxes {
    fn new(node: Vec<Aabb>, topology: &Topology) -> Self {
        let mut boxes = Self { node, edge: Vec::new(), face: Vec::new() };
        boxes.fit(topology);
        boxes
    }

    /// Fits the boxes of edges and faces to those of nodes.
    fn fit(&mut self, topology: &Topology) {
        let of = |n: u32| &self.node[n as usize];
        self.edge.clear();
        let edges = topology.edges().iter().map(|e| e.corners);
        self.edge.extend(edges.map(|[a, b]| of(a).merged(of(b))));
        self.face.clear();
        let faces = topology.triangles().iter();
        self.face.extend(faces.map(|&[a, b, c]| of(a).merged(of(b)).merged(of(c))));
    }

    /// The pairs that two faces answer for; the same whichever of them is named first.
    fn push_pairs(&self, topology: &Topology, faces: [u32; 2], found: &mut Vec<ClothPair>) {
        let faces = [faces[0].min(faces[1]), faces[0].max(faces[1])];
        let [one, other] = faces.map(|f| &self.face[f as usize]);
        let common = Aabb::new(one.mins.max(other.mins), one.maxs.min(other.maxs));
        self.push_node_faces(topology, faces, &common, found);
        self.push_node_faces(topology, [faces[1], faces[0]], &common, found);
        let [of_one, of_other] = faces.map(|f| (topology.owned(f).edge, topology.edges_of(f)));
        for i in 0..3 {
            let edge = of_one.1[i] as usize;
            if !of_one.0[i] || !meet(&self.edge[edge], &common) {
                continue;
            }
            let [a, b] = topology.edges()[edge].corners;
            for j in 0..3 {
                let second = of_other.1[j] as usize;
                if !of_other.0[j] || !meet(&self.edge[edge], &self.edge[second]) {
                    continue;
                }
                let [c, d] = topology.edges()[second].corners;
                if a != c && a != d && b != c && b != d {
                    let corner = |face: u32, k: usize| 3 * face + (k % 3) as u32;
                    let ends = |face: u32, k: usize| [corner(face, k + 1), corner(face, k + 2)];
                    let ([a, b], [c, d]) = (ends(faces[0], i), ends(faces[1], j));
                    let features = Features::EdgeEdge;
                    found.push(ClothPair { features, corners: [a, b, c, d] });
                }
            }
        }
    }

    /// Nodes that the first face answers for, against the second.
    fn push_node_faces(
        &self,
        topology: &Topology,
        [own, face]: [u32; 2],
        common: &Aabb,
        found: &mut Vec<ClothPair>,
    ) {
        let nodes = topology.triangles()[own as usize];
        let owned = topology.owned(own).corner;
        for k in 0..3 {
            if owned[k]
                && meet(&self.node[nodes[k] as usize], common)
                && !topology.triangles()[face as usize].contains(&nodes[k])
            {
                let [a, b, c] = [0, 1, 2].map(|k| 3 * face + k);
                let corners = [3 * own + k as u32, a, b, c];
                found.push(ClothPair { features: Features::VertexFace, corners });
            }
        }
    }
}

fn around([start, end]: [DVec3; 2]) -> Aabb {
    Aabb::new(start.min(end), start.max(end))
}

/// Of as many values; zero of none.
fn mean(count: usize, value: impl Fn(usize) -> DVec3) -> DVec3 {
    (0..count).map(value).sum::<DVec3>() / count.max(1) as f64
}

fn are_few(count: usize, nodes: &[DVec3]) -> bool {
    count as f64 <= OTHERS_SHARE_MAX * nodes.len() as f64
}

fn meet(a: &Aabb, b: &Aabb) -> bool {
    (a.mins.cmple(b.maxs) & b.mins.cmple(a.maxs)).all()
}

/// Whether two features are farther apart than a reach (m) along one of the axes, by boxes from the
/// low to the high corners of each of their points. Tells most pairs.
pub(super) fn are_apart(features: Features, low: [DVec3; 4], high: [DVec3; 4], reach: f64) -> bool {
    let box_of = |points: std::ops::Range<usize>| {
        let lowest = low[points.clone()].iter().copied().reduce(DVec3::min);
        (
            lowest.unwrap_or_default(),
            high[points].iter().copied().reduce(DVec3::max).unwrap_or_default(),
        )
    };
    let first = point_count_of_first(features);
    let (a, b) = (box_of(0..first), box_of(first..4));
    let reach = DVec3::splat(reach);
    (a.0.cmpgt(b.1 + reach) | b.0.cmpgt(a.1 + reach)).any()
}
