/** Made by the bundler of the folder `thumbnails`: the file of each robot's small picture, named by its content. */
declare module "gelenk:thumbnails" {
  const files: Readonly<Record<string, string>>;
  export default files;
}
