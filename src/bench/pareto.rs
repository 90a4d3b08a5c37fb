//! Pareto fronts of time and quality.

/// Indices of the points on the Pareto front, by rising x: no other point is faster (x smaller) without being worse (y smaller).
#[must_use]
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    // Among points of one time the best comes first.
    order.sort_by(|&a, &b| {
        let ((ax, ay), (bx, by)) = (points[a], points[b]);
        ax.total_cmp(&bx).then(by.total_cmp(&ay))
    });
    let mut best = f64::NEG_INFINITY;
    order.retain(|&i| {
        let better = points[i].1 > best;
        best = best.max(points[i].1);
        better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::front;

    #[test]
    fn what_is_beaten_is_not_on_it() {
        let points = [
            (8.0, 99.0),
            (3.0, 30.0),
            (4.0, 25.0),
            (5.0, 99.0),
            (1.0, 20.0),
            (1.0, 10.0),
        ];
        assert_eq!(front(&points), [4, 1, 3]);
        assert!(front(&[]).is_empty());
    }

    #[test]
    fn equal_points_are_on_it_once() {
        assert_eq!(front(&[(2.0, 5.0), (2.0, 5.0)]), [0]);
    }
}
