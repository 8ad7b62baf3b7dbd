//! One step of the motion, with its transition matrix and the weights of its inputs.

/// Coefficients of the axis's equation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dynamics {
    pub(super) alpha: f64,
    pub(super) linear: f64,
    pub(super) quadratic: f64,
    pub(super) cubic: f64,
    pub(super) skew: f64,
    pub(super) stiffness: f64,
}

/// Output, its rate and acceleration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Point {
    pub(super) position: f64,
    pub(super) velocity: f64,
    pub(super) acceleration: f64,
}

/// What a step did.
#[derive(Clone, Copy, Debug)]
pub(super) struct MotionStep {
    pub(super) end: Point,
    /// State half-way.
    pub(super) middle: Point,
    /// Transition matrix of position and velocity over the step.
    pub(super) transition: [[f64; 2]; 2],
    /// The first row of the transition matrix half-way.
    pub(super) half: [f64; 2],
    /// Weights of the force per inertia at the beginning and half-way in position and velocity at the end, times
    /// Simpson's weights; at the end it makes `end_weight` of velocity.
    pub(super) begin_weight: [f64; 2],
    pub(super) middle_weight: [f64; 2],
    pub(super) end_weight: f64,
}

impl Dynamics {
    pub(super) fn acceleration(&self, position: f64, velocity: f64, force: f64) -> f64 {
        let drag = (1.0 + self.skew * velocity.signum()) * self.even_drag(velocity);
        (force - drag - self.stiffness * position) / self.alpha
    }

    /// Drag alike to both sides.
    pub(super) fn even_drag(&self, velocity: f64) -> f64 {
        (self.linear + (self.quadratic + self.cubic * velocity.abs()) * velocity.abs()) * velocity
    }

    /// Derivative of the drag with respect to velocity, over the inertia.
    fn damping(&self, velocity: f64) -> f64 {
        let speed = velocity.abs();
        let drag = (1.0 + self.skew * velocity.signum())
            * (self.linear + (2.0 * self.quadratic + 3.0 * self.cubic * speed) * speed);
        drag / self.alpha
    }

    /// The fastest rate of the motion up to a speed, per s.
    pub(super) fn rate(&self, speed: f64) -> f64 {
        let drag = (1.0 + self.skew.abs())
            * (self.linear.abs() + (2.0 * self.quadratic.abs() + 3.0 * self.cubic.abs() * speed) * speed);
        drag / self.alpha + (self.stiffness.abs() / self.alpha).sqrt()
    }

    /// Advances by `h_s` under the forces at the beginning, half-way and at the end (Runge-Kutta of order four).
    pub(super) fn step(&self, (x, v): (f64, f64), [begin, middle, end]: [f64; 3], h_s: f64) -> MotionStep {
        let half = 0.5 * h_s;
        let a1 = self.acceleration(x, v, begin);
        let (x2, v2) = (x + half * v, v + half * a1);
        let a2 = self.acceleration(x2, v2, middle);
        let (x3, v3) = (x + half * v2, v + half * a2);
        let a3 = self.acceleration(x3, v3, middle);
        let (x4, v4) = (x + h_s * v3, v + h_s * a3);
        let a4 = self.acceleration(x4, v4, end);
        let position = x + h_s / 6.0 * (v + 2.0 * (v2 + v3) + v4);
        let velocity = v + h_s / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
        let acceleration = self.acceleration(position, velocity, end);
        // Hermite's cubic half-way.
        let middle_position = 0.5 * (x + position) + 0.125 * h_s * (v - velocity);
        let middle_velocity = 0.5 * (v + velocity) + 0.125 * h_s * (a1 - acceleration);
        let middle = Point {
            position: middle_position,
            velocity: middle_velocity,
            acceleration: self.acceleration(middle_position, middle_velocity, middle),
        };
        let (d0, d1, d2) = (self.damping(v), self.damping(middle_velocity), self.damping(velocity));
        let first = self.exponential(0.5 * (d0 + d1), half);
        let second = self.exponential(0.5 * (d1 + d2), half);
        let transition = product(&second, &first);
        MotionStep {
            end: Point { position, velocity, acceleration },
            middle,
            transition,
            half: first[0],
            begin_weight: [h_s / 6.0 * transition[0][1], h_s / 6.0 * transition[1][1]],
            middle_weight: [h_s / 1.5 * second[0][1], h_s / 1.5 * second[1][1]],
            end_weight: h_s / 6.0,
        }
    }

    /// Exponential of `M = [[0, 1], [-k/alpha, -damping]] t` by its series to the fourth power, as `one + by_matrix M`: by
    /// Cayley and Hamilton no higher power of M is needed.
    fn exponential(&self, damping: f64, t: f64) -> [[f64; 2]; 2] {
        let (spring, trace) = (self.stiffness / self.alpha * t, -damping * t);
        let determinant = spring * t;
        let (mut one, mut by_matrix) = (1.0, 0.0);
        for share in [1.0 / 4.0, 1.0 / 3.0, 1.0 / 2.0, 1.0] {
            (one, by_matrix) = (1.0 - share * determinant * by_matrix, share * (one + trace * by_matrix));
        }
        [[one, by_matrix * t], [-by_matrix * spring, one + by_matrix * trace]]
    }
}

fn product(a: &[[f64; 2]; 2], b: &[[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let entry = |row: usize, column: usize| a[row][0] * b[0][column] + a[row][1] * b[1][column];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}
