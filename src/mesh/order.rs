//! An order of nodes, vertices and faces in which what is near in the mesh is near in memory.

use super::{CornerId, FaceId, Id, IdVec, Mesh, NodeId};

impl Mesh {
    /// The same mesh with its nodes in reverse Cuthill-McKee order
    /// ([`CM69`](crate::papers::CM69)), vertices in the order of their nodes and faces in that of
    /// their first vertex.
    ///
    /// Sweeps over the mesh stay in the cache, and an incomplete factorisation in this order is a
    /// far better one than in the order of edits. Depends on the mesh alone.
    pub fn in_local_order(self) -> Self {
        let nodes = Order::<NodeId>::of(cuthill_mckee(&Neighbours::of(&self)));
        let vertices = Order::sorted(self.vertex_ids(), |v| nodes.new_id(self.node_of(v)).index());
        let first_vertex = |f: FaceId| {
            let vertices = self.face_vertices(f).map(|v| vertices.new_id(v).index());
            vertices.into_iter().min().unwrap_or(0)
        };
        let faces = Order::sorted(self.face_ids(), first_vertex);
        let corners = faces.corners();
        let new_corner = |c: CornerId| faces.new_id(c.face()).corner(c.position());
        Self {
            position: nodes.arranged(&self.position),
            velocity: nodes.arranged(&self.velocity),
            node_origin: nodes.arranged(&self.node_origin),
            corner_of_node: nodes.arranged(&self.corner_of_node).map(new_corner),
            metric: vertices.arranged(&self.metric),
            material: vertices.arranged(&self.material),
            node_of_vertex: vertices.arranged(&self.node_of_vertex).map(|n| nodes.new_id(n)),
            view_factor: faces.arranged(&self.view_factor),
            vertices_of_face: faces
                .arranged(&self.vertices_of_face)
                .map(|f| f.map(|v| vertices.new_id(v))),
            opposite: corners.arranged(&self.opposite).map(|o| o.map(new_corner)),
            rest_angle: corners.arranged(&self.rest_angle),
        }
    }
}

/// A renumbering.
struct Order<I> {
    old_of_new: Vec<I>,
    new_of_old: IdVec<I, I>,
}

impl<I: Id> Order<I> {
    fn of(old_of_new: Vec<I>) -> Self {
        let mut new_of_old = IdVec::filled(I::from_index(0), old_of_new.len());
        for (new, &old) in old_of_new.iter().enumerate() {
            new_of_old[old] = I::from_index(new);
        }
        Self { old_of_new, new_of_old }
    }

    /// By a key; equal ones stay in order.
    fn sorted(ids: impl Iterator<Item = I>, key: impl Fn(I) -> usize) -> Self {
        let mut old_of_new: Vec<I> = ids.collect();
        old_of_new.sort_by_cached_key(|&id| key(id));
        Self::of(old_of_new)
    }

    fn new_id(&self, old: I) -> I {
        self.new_of_old[old]
    }

    fn arranged<T: Copy>(&self, values: &IdVec<I, T>) -> IdVec<I, T> {
        self.old_of_new.iter().map(|&old| values[old]).collect()
    }
}

impl Order<FaceId> {
    /// Corners go with their faces.
    fn corners(&self) -> Order<CornerId> {
        Order::of(self.old_of_new.iter().flat_map(|f| f.corners()).collect())
    }
}

/// The nodes that share an edge with each node, ascending by the number of their own.
struct Neighbours {
    start: Vec<u32>,
    nodes: Vec<NodeId>,
}

impl Neighbours {
    fn of(mesh: &Mesh) -> Self {
        let mut degree = vec![0u32; mesh.node_count()];
        for edge in mesh.edges() {
            mesh.edge_nodes(edge).iter().for_each(|n| degree[n.index()] += 1);
        }
        let mut start = vec![0u32];
        start.extend(degree.iter().scan(0, |sum, d| {
            *sum += d;
            Some(*sum)
        }));
        let mut fill = start.clone();
        let mut nodes = vec![NodeId::from_index(0); start.last().map_or(0, |&n| n as usize)];
        for edge in mesh.edges() {
            let [a, b] = mesh.edge_nodes(edge);
            for (from, to) in [(a, b), (b, a)] {
                nodes[fill[from.index()] as usize] = to;
                fill[from.index()] += 1;
            }
        }
        for node in 0..degree.len() {
            let range = start[node] as usize..start[node + 1] as usize;
            nodes[range].sort_unstable_by_key(|n| (degree[n.index()], n.index()));
        }
        Self { start, nodes }
    }

    fn node_count(&self) -> usize {
        self.start.len() - 1
    }

    fn of_node(&self, node: NodeId) -> &[NodeId] {
        &self.nodes[self.start[node.index()] as usize..self.start[node.index() + 1] as usize]
    }
}

/// Every connected piece breadth first from an end of it, then all backwards.
fn cuthill_mckee(neighbours: &Neighbours) -> Vec<NodeId> {
    let count = neighbours.node_count();
    let mut order = Vec::with_capacity(count);
    let (mut reached, mut placed) = (vec![false; count], vec![false; count]);
    for seed in (0..count).map(NodeId::from_index) {
        if placed[seed.index()] {
            continue;
        }
        // The last node found from anywhere lies at an end of the piece.
        let mut walk = Vec::new();
        breadth_first(neighbours, seed, &mut reached, &mut walk);
        let end = walk.last().copied().unwrap_or(seed);
        breadth_first(neighbours, end, &mut placed, &mut order);
    }
    order.reverse();
    order
}

/// Appends all nodes that can be reached from `seed` and are not marked yet, and marks them.
fn breadth_first(
    neighbours: &Neighbours,
    seed: NodeId,
    marked: &mut [bool],
    order: &mut Vec<NodeId>,
) {
    let mut next = order.len();
    marked[seed.index()] = true;
    order.push(seed);
    while next < order.len() {
        for &node in neighbours.of_node(order[next]) {
            if !std::mem::replace(&mut marked[node.index()], true) {
                order.push(node);
            }
        }
        next += 1;
    }
}
