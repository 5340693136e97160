"""What every registered method keeps, whatever its name: new ones are covered as they come."""
