"""What the dashboards have in common: data, layout, progress, and work beside the kernel."""
