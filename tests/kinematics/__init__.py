"""What a robot does: poses, Jacobians and their certificates."""
